// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/pivot/pivot_geometry.h"
#include "vision/pivot/screw.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The point about which the blades turn; stored pixels.
struct Pivot {
  Eigen::Vector2d point_px{0, 0};
  Eigen::Matrix2d covariance_px2;
  std::string source;                     // "screw", "geometry", "hint"
  double asymmetry = 0;                   // see EdgeAsymmetry; 0 if bent
  double unlikeness = 0;                  // see EdgeUnlikeness; 0 if bent
  bool bent = false;                      // see AreBentToOneSide
  double overlap = 0, overlap_sigma = 0;  // see EdgeOverlap
  double off_geometry = 0;     // standard uncertainties from where the blades alone put it
  std::optional<Screw> screw;  // if one is seen
  bool off_screw = false;      // a hint, and a screw is plainly seen elsewhere
  Eigen::Vector2d geometry_px = Eigen::Vector2d::Zero();  // where the blades alone put it

  // In any direction, root mean square.
  [[nodiscard]] double SigmaPx() const { return std::sqrt(covariance_px2.trace() / 2); }
};

// What is known before the pivot is looked for; all in stored pixels.
struct PivotSearch {
  const Scene& scene;
  EdgePair edges;
  std::optional<Eigen::Vector2d> hint_px;
  std::optional<Screw> at_joint = std::nullopt;  // what LookAtJoint found
};

// In the plane of the edges: below the screw's head if that is seen; else on the line about which
// the two edges mirror each other, where the members' overlap and the edges' usual overlap put it.
[[nodiscard]] Pivot FindPivot(const cv::Mat& grey,
                              const ScaleResult& scale,
                              const PivotSearch& search);

// What the edges say of a pivot, once more, as one of them was located anew.
void CompareEdges(const ScaleResult& scale,
                  const Scene& scene,
                  const EdgePair& edges,
                  Pivot* pivot);

// By the two edges and the silhouette alone, as where no head is seen.
[[nodiscard]] Pivot PivotByBlades(const ScaleResult& scale,
                                  const Scene& scene,
                                  const EdgePair& edges);

}  // namespace bladecurve
