// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/edge/edge.h"

namespace bladecurve {

// Why an edge was placed where it is, for the next one to find out. CV_8UC3. Above, the picture
// straightened along the edge, the blade on top: inlying points green, rejected ones red, the trend
// of the edge blue, the other transition that might be the border yellow. Below, the grey values
// across the edge, each curve the mean of an eighth of its length, with the edge where it was
// found.
[[nodiscard]] cv::Mat DrawEdge(const cv::Mat& grey, const LocatedEdge& edge);

}  // namespace bladecurve
