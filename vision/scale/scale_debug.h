// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/scale/scale.h"

namespace bladecurve {

// The photograph made small, with the markers that are seen and their numbers: green where the
// corners were located, red where a side is missing. CV_8UC3.
[[nodiscard]] cv::Mat DrawMarkers(const cv::Mat& grey, const std::vector<SeenMarker>& markers);

}  // namespace bladecurve
