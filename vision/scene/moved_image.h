// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// How well what a thing does not cover of its own image, moved, agrees with another mask.
struct MovedImage {
  cv::Vec2i shift_px{0, 0};
  double agreement = 0;  // what both set, of what either sets, give or take two pixels; 0 to 1
};

// The image of `thing`, moved by up to a seventh of the picture, that agrees best with `other`.
// CV_8UC1, without anything in common.
[[nodiscard]] MovedImage BestMovedImage(const cv::Mat& thing, const cv::Mat& other);

}  // namespace bladecurve
