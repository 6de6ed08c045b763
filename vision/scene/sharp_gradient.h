// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// What is left of the colour gradient where it is sharp, Lab units per px, CV_32FC1: a border that
// is as steep at a coarse scale as at a fine one is a shadow's. `lab` CV_32FC3.
[[nodiscard]] cv::Mat SharpGradient(const cv::Mat& lab);

// Sharp outlines as walls: that gradient in units of its median over the picture, CV_32FC1, gaps up
// to `closed_px`, odd, closed; 0 where `ignore` (CV_8UC1, may be empty) is not.
[[nodiscard]] cv::Mat Walls(const cv::Mat& sharp_gradient, int closed_px, const cv::Mat& ignore);

// Walls sorted into bins, CV_8UC1, twelve to the octave from a quarter of the median up.
inline constexpr int kWallBins = 128;
[[nodiscard]] cv::Mat WallBins(const cv::Mat& walls);
[[nodiscard]] float WallOfBin(int bin);

// Non-zero, CV_8UC1, at the pixels of the frame that look like the background by their `distance`
// from it, CV_32FC1: metal that is cut off does not.
[[nodiscard]] cv::Mat GroundAtFrame(const cv::Mat& distance);

}  // namespace bladecurve
