// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/imgproc.hpp>

namespace bladecurve {

// A structuring element, `size_px` wide.
[[nodiscard]] inline cv::Mat Disk(int size_px) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size_px, size_px});
}

}  // namespace bladecurve
