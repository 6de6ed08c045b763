// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/tone_curve.h"

namespace bladecurve {

// The head of the screw or rivet about which the blades turn, as an ellipse.
struct Screw {
  Eigen::Vector2d center_px;
  Eigen::Matrix2d covariance_px2;
  double semi_major_px = 0, semi_minor_px = 0, angle_rad = 0;
  double support = 0;  // share of the rim that is seen, 0 to 1
};

struct ScrewSearch {
  Eigen::Vector2d guess_px;       // where geometry puts the pivot
  double radius_px = 0;           // how far from there the centre may lie
  double min_semi_axis_px = 3;    // size of the head, from the width of the shank
  double max_semi_axis_px = 0;
};

// The screw's rim found and fitted to sub-pixel; std::nullopt where none is visible with confidence.
[[nodiscard]] std::optional<Screw> FindScrew(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const ScrewSearch& search);

}  // namespace bladecurve
