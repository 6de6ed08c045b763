// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace bladecurve {

// As std::lround where that is not negative, else -1: beyond the picture. Many times as fast.
[[nodiscard]] inline int NearestPixel(double coordinate_px) {
  return coordinate_px > -0.5 ? static_cast<int>(coordinate_px + 0.5) : -1;
}

[[nodiscard]] inline cv::Point NearestPixel(const Eigen::Vector2d& at_px) {
  return {NearestPixel(at_px.x()), NearestPixel(at_px.y())};
}

}  // namespace bladecurve
