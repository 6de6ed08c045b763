// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// How sharp a border one must cross to reach each pixel from the frame of the picture: the least,
// over all paths, of the largest colour gradient on the way, in units of the usual gradient of the
// picture (its median). CV_32FC1. Folds and soft shadows are reached over gentle slopes; metal is
// walled in by its own sharp outline, also where its colour is the background's (the flooding of
// watersheds, Meyer 1994; gaps of the wall up to `closed_px`, odd, are closed first).
// `lab` CV_32FC3; `distance` CV_32FC1, from the background, says which parts of the frame are
// background; `ignore` (CV_8UC1, may be empty) is non-zero where a pixel is nothing to look at.
[[nodiscard]] cv::Mat FloodLevels(const cv::Mat& lab,
                                  const cv::Mat& distance,
                                  const cv::Mat& ignore,
                                  int closed_px);

}  // namespace bladecurve
