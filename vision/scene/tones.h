// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

// The tones in which things stand out, as peaks of the histogram of their lightness, and the
// valleys between them, darkest first; lightness. One more peak than valleys.
struct Tones {
  std::vector<double> peaks, valleys;
};

// Of what lies within `things` (CV_8UC1): their borders have all tones. `lightness`: CV_32FC1, -100
// to 100.
[[nodiscard]] Tones TonesOf(const cv::Mat& lightness, const cv::Mat& things);

}  // namespace bladecurve
