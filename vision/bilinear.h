// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>

namespace bladecurve {

// value(pixel) between the four pixels about `at`, of a picture with one channel of type Pixel and
// at least two rows and columns; beyond the picture its border repeats.
template <typename Pixel, typename Value>
[[nodiscard]] double Bilinear(const cv::Mat& picture,
                              const Eigen::Vector2d& at,
                              const Value& value) {
  const double x = std::clamp(at.x(), 0.0, picture.cols - 1.001);
  const double y = std::clamp(at.y(), 0.0, picture.rows - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double right = x - column, down = y - row;
  const Pixel* upper = picture.ptr<Pixel>(row) + column;
  const Pixel* lower = picture.ptr<Pixel>(row + 1) + column;
  return (1 - down) * ((1 - right) * value(upper[0]) + right * value(upper[1])) +
         down * ((1 - right) * value(lower[0]) + right * value(lower[1]));
}

template <typename Pixel>
[[nodiscard]] double Bilinear(const cv::Mat& picture, const Eigen::Vector2d& at) {
  return Bilinear<Pixel>(picture, at, [](Pixel pixel) { return static_cast<double>(pixel); });
}

}  // namespace bladecurve
