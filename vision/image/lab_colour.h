// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// CIE 1976 L*a*b* (CIE 15, white point D65) of an sRGB picture: CV_8UC3 in the order BGR to
// CV_32FC3 in [0, 100] x about [-90, 100] x [-110, 95]. As cv::cvtColor gives it, to 0.02, and like
// it within 0.5 of the definition; but that takes 0.2 s for its tables in each process. Throws
// std::invalid_argument for other pictures.
[[nodiscard]] cv::Mat LabFromBgr(const cv::Mat& bgr);

}  // namespace bladecurve
