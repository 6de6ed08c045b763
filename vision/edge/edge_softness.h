// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/edge/edge_path.h"

namespace bladecurve {

// Whether light along most of a path differs between its two sides, but changes too slowly across
// it for an edge: out of focus, or moved. grey: CV_8UC1.
[[nodiscard]] bool IsBlurredAway(const cv::Mat& grey, const EdgePath& path);

}  // namespace bladecurve
