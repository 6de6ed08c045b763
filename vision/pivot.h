// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/scene.h"
#include "vision/tone_curve.h"

namespace bladecurve {

// The point about which the blades turn; stored pixels.
struct Pivot {
  Eigen::Vector2d point_px;
  Eigen::Matrix2d covariance_px2;
  std::string source;    // "screw", "geometry", "hint"
  double asymmetry = 0;  // see EdgeAsymmetry
};

// The two cutting edges, from the crotch to the distal end.
struct EdgePair {
  std::vector<Eigen::Vector2d> left_px, right_px;
};

// The screw if it is seen; else the middle of the overlap, moved onto the line about which the two
// edges mirror each other.
[[nodiscard]] Pivot FindPivot(const cv::Mat& grey,
                              const ToneCurve& tone,
                              const Scene& scene,
                              const EdgePair& edges,
                              const std::optional<Eigen::Vector2d>& hint_px);

// How differently the two edges pass by the pivot: difference of their signed distances from it
// over the length of the blades. Blades in one plane pass alike (below 0.1); angled ones (Lister,
// Potts) do not.
[[nodiscard]] double EdgeAsymmetry(const EdgePair& edges, const Eigen::Vector2d& pivot_px);

}  // namespace bladecurve
