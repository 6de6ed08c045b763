// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// Some of a picture's pixels, or all of them, and where in the picture the first one lies.
struct PicturePart {
  cv::Mat pixels;
  cv::Point corner_px;

  PicturePart() = default;
  PicturePart(const cv::Mat& whole) : pixels(whole) {}  // NOLINT(google-explicit-constructor)
  PicturePart(const cv::Mat& part, const cv::Point& corner) : pixels(part), corner_px(corner) {}

  // Of the picture.
  [[nodiscard]] cv::Rect Area() const { return {corner_px, pixels.size()}; }
};

}  // namespace bladecurve
