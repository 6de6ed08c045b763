// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// How sharp a border one must cross to reach each pixel from the `ground` (CV_8UC1, non-zero where
// the background is for sure): the least, over all paths, of the highest of the `walls` on the way
// (CV_32FC1, see Walls). CV_32FC1. Folds and soft shadows are reached over gentle slopes; metal is
// walled in by its own sharp outline, also where its colour is the background's (the flooding of
// watersheds, Meyer 1994).
[[nodiscard]] cv::Mat FloodLevels(const cv::Mat& walls, const cv::Mat& ground);

}  // namespace bladecurve
