// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// How many finger rings a mask shows (CV_8UC1): holes that are ellipses with a wall all about them,
// alike in size. A pair of scissors has two.
[[nodiscard]] int CountFingerRings(const cv::Mat& mask);

}  // namespace bladecurve
