// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// What is left of the colour gradient where it is sharp, Lab units per px, CV_32FC1: a border that
// is as steep at a coarse scale as at a fine one is a shadow's. `lab` CV_32FC3.
[[nodiscard]] cv::Mat SharpGradient(const cv::Mat& lab);

// How sharp a border one must cross to reach each pixel from the frame of the picture: the least,
// over all paths, of the largest sharp gradient on the way, in units of the usual one of the
// picture (its median). CV_32FC1. Folds and soft shadows are reached over gentle slopes; metal is
// walled in by its own sharp outline, also where its colour is the background's (the flooding of
// watersheds, Meyer 1994; gaps of the wall up to `closed_px`, odd, are closed first).
// `distance` CV_32FC1, from the background, says which parts of the frame are background; `ignore`
// (CV_8UC1, may be empty) is non-zero where a pixel is nothing to look at.
[[nodiscard]] cv::Mat FloodLevels(const cv::Mat& sharp_gradient,
                                  const cv::Mat& distance,
                                  const cv::Mat& ignore,
                                  int closed_px);

}  // namespace bladecurve
