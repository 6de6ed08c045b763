// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// A picture of `size`, no larger than the image, of means over areas, as cv::resize with INTER_AREA
// makes it; by several threads, as far as rows of both have borders in common.
[[nodiscard]] cv::Mat Reduced(const cv::Mat& image, const cv::Size& size);

}  // namespace bladecurve
