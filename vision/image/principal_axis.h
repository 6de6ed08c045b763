// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bladecurve {

// Unit vector along which a shape is longest.
[[nodiscard]] inline Eigen::Vector2d PrincipalAxis(const cv::Moments& m) {
  const double angle = 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace bladecurve
