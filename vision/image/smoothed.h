// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// The image after a Gaussian of `sigma` px, any number of channels; on the threads that are idle.
[[nodiscard]] cv::Mat Smoothed(const cv::Mat& image, double sigma);

}  // namespace bladecurve
