// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>

namespace bladecurve {

// Whether Bilinear needs nothing of what lies beyond the picture's border.
[[nodiscard]] inline bool LiesWithin(const cv::Mat& picture, const Eigen::Vector2d& at) {
  return at.x() >= 0 && at.y() >= 0 && at.x() <= picture.cols - 1.001 &&
         at.y() <= picture.rows - 1.001;
}

// Bilinear at a place that lies within the picture.
template <typename Pixel, typename Value>
[[nodiscard]] double BilinearWithin(const cv::Mat& picture,
                                    const Eigen::Vector2d& at,
                                    const Value& value) {
  const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
  const double right = at.x() - column, down = at.y() - row;
  const Pixel* upper = picture.ptr<Pixel>(row) + column;
  const Pixel* lower = picture.ptr<Pixel>(row + 1) + column;
  return (1 - down) * ((1 - right) * value(upper[0]) + right * value(upper[1])) +
         down * ((1 - right) * value(lower[0]) + right * value(lower[1]));
}

template <typename Pixel>
[[nodiscard]] double BilinearWithin(const cv::Mat& picture, const Eigen::Vector2d& at) {
  return BilinearWithin<Pixel>(picture, at, [](Pixel pixel) { return static_cast<double>(pixel); });
}

// value(pixel) between the four pixels about `at`, of a picture with one channel of type Pixel and
// at least two rows and columns; beyond the picture its border repeats.
template <typename Pixel, typename Value>
[[nodiscard]] double Bilinear(const cv::Mat& picture,
                              const Eigen::Vector2d& at,
                              const Value& value) {
  const double x = std::clamp(at.x(), 0.0, picture.cols - 1.001);
  const double y = std::clamp(at.y(), 0.0, picture.rows - 1.001);
  return BilinearWithin<Pixel>(picture, {x, y}, value);
}

template <typename Pixel>
[[nodiscard]] double Bilinear(const cv::Mat& picture, const Eigen::Vector2d& at) {
  return Bilinear<Pixel>(picture, at, [](Pixel pixel) { return static_cast<double>(pixel); });
}

}  // namespace bladecurve
