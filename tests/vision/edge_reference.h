// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace bladecurve::testing {

// A piece of a straight edge {normal . p = offset}, blade where less, about `middle_px`.
struct TrueEdge {
  Eigen::Vector2d middle_px, normal;
  double length_px = 300, blur_px = 1, blade = 60, ground = 180;  // levels in grey values
  double reach_px = 6;                                            // pixels used on either side
};

// Error of the offset that maximum likelihood makes on a linear picture of the edge: told that edge
// and light are even, with angle, levels and blur to find from a start at the truth. What a locator
// errs beyond it on the same picture is its own loss, whatever the draw of the noise.
[[nodiscard]] double ReferenceError(const cv::Mat& grey, const TrueEdge& edge);

}  // namespace bladecurve::testing
