// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// How high walls part each pixel from the `ground` on the average of their length, CV_32FC1;
// `walls` and `ground` as for FloodLevels. Regions, at first the basins of the walls (Meyer 1994),
// are merged in the order of the mean height along their common border, as in the ultrametric
// contour maps of Arbelaez et al. 2011; a pixel's level is that at which its region has become one
// with the ground. So what is sharply outlined stays apart although its outline is lost for a
// while, where a flood would run in.
[[nodiscard]] cv::Mat MergingLevels(const cv::Mat& walls, const cv::Mat& ground);

}  // namespace bladecurve
