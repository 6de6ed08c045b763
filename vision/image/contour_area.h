// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

namespace bladecurve {

// Pixels within a closed contour and on it, by Pick's theorem: cv::contourArea takes it for a line
// through their centres, which leaves nothing of what is a pixel wide.
[[nodiscard]] inline double PixelsWithin(const std::vector<cv::Point>& contour) {
  return cv::contourArea(contour) + 0.5 * cv::arcLength(contour, true) + 1;
}

}  // namespace bladecurve
