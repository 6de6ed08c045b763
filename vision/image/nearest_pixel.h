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

// Whether a CV_8UC1 mask is set there; beyond its frame it is not.
[[nodiscard]] inline bool IsSetAt(const cv::Mat& mask, const Eigen::Vector2d& at_px) {
  const cv::Point pixel = NearestPixel(at_px);
  return cv::Rect({}, mask.size()).contains(pixel) && mask.at<uchar>(pixel) != 0;
}

// Whether it is set there or up to two pixels beside, in both directions.
[[nodiscard]] inline bool IsSetNear(const cv::Mat& mask, const Eigen::Vector2d& at_px) {
  const cv::Point pixel = NearestPixel(at_px);
  const cv::Rect near = cv::Rect(pixel.x - 2, pixel.y - 2, 5, 5) & cv::Rect({}, mask.size());
  return !near.empty() && cv::countNonZero(mask(near)) > 0;
}

}  // namespace bladecurve
