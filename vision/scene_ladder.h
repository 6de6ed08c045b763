// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/background.h"
#include "vision/blades.h"
#include "vision/scene.h"

namespace bladecurve {

// A small version of the photograph, or of a part of it.
struct ScaledImage {
  cv::Mat pixels;  // CV_32FC1 (lightness, 0 to 100) or CV_32FC3 (Lab)
  Window window;

  [[nodiscard]] double full_px_per_px() const { return window.area_px.width / pixels.cols; }
  [[nodiscard]] Eigen::Vector2d FullFromSmall(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d origin(window.area_px.x, window.area_px.y);
    return (p + Eigen::Vector2d(0.5, 0.5)) * full_px_per_px() + origin - Eigen::Vector2d(0.5, 0.5);
  }
  [[nodiscard]] Eigen::Vector2d SmallFromFull(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d origin(window.area_px.x, window.area_px.y);
    return (p + Eigen::Vector2d(0.5, 0.5) - origin) / full_px_per_px() - Eigen::Vector2d(0.5, 0.5);
  }
};

// A pair of blades that some rung of the ladder found.
struct Candidate {
  BladePair pair;
  std::shared_ptr<const ScaledImage> at;
  cv::Mat mask;
  std::string method;  // "grey", "colour", "shadow-blind", "flood"
  double threshold = 0;
  double strength =
      0;  // mean transition across the inner edges: the right threshold has the strongest
  double sharpness = 0;  // of the softer inner edge: 1 for a step, 0.3 for a soft shadow
  int agreeing = 0;  // thresholds of the same rung that found the same blades
};

struct LadderResult {
  Candidate best;        // quality 0 if nothing was found
  bool several = false;  // two good pairs in different places
};

// Tries one rung after the other until one gives a consistent pair of blades; logs what ran and
// why.
[[nodiscard]] LadderResult ClimbLadder(const Photo& photo,
                                       const std::vector<SeenMarker>& markers,
                                       const StoredHints& hints,
                                       StageLog* log);

}  // namespace bladecurve
