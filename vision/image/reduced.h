// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace bladecurve {

// Places in a picture of one pixel for each factor x factor pixels, and back.
struct Reduction {
  Eigen::Vector2d corner_px;  // of the part of the photograph that was reduced
  int factor = 1;

  [[nodiscard]] Eigen::Vector2d There(const Eigen::Vector2d& px) const {
    return (px - corner_px - Centre()) / factor;
  }
  [[nodiscard]] Eigen::Vector2d Back(const Eigen::Vector2d& px) const {
    return corner_px + Centre() + factor * px;
  }
  // Of the first pixel.
  [[nodiscard]] Eigen::Vector2d Centre() const {
    return Eigen::Vector2d::Constant(0.5 * (factor - 1));
  }
};

// A picture of `size`, no larger than the image, of means over areas, as cv::resize with INTER_AREA
// makes it; by several threads, as far as rows of both have borders in common.
[[nodiscard]] cv::Mat Reduced(const cv::Mat& image, const cv::Size& size);

}  // namespace bladecurve
