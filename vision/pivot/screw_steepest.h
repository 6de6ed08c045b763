// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace bladecurve {

// Where light changes most on the way out of a head to its surroundings, direction by direction. Of
// a head that is its rim, whatever that looks like: a groove here, a glint there, a step elsewhere.
// About other places hardly more than half of these places lie on one circle.
struct SteepestCircle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // of the circle on which most of them lie
  double radius_px = 0;
  double share = 0;        // of the directions, those whose place lies on it
  double third_share = 0;  // the same of that third of the directions where it is least
};

// Near a circle that is good to a fifth of its radius. `smooth`: CV_32F, blurred by about a pixel.
[[nodiscard]] SteepestCircle FindSteepest(const cv::Mat& smooth,
                                          const Eigen::Vector2d& center,
                                          double radius_px);

}  // namespace bladecurve
