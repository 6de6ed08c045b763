// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/pivot/pivot.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The overlap of the blades with what speaks for the pivot: both crotches (orange, cyan), the place
// that geometry gives (white cross), the screw's rim if one is seen (green), and the pivot with its
// standard uncertainty (yellow). grey: CV_8UC1; returns CV_8UC3.
[[nodiscard]] cv::Mat DrawPivot(const cv::Mat& grey, const Scene& scene, const Pivot& pivot);

}  // namespace bladecurve
