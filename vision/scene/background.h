// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

// The background as a smooth surface per channel: a bicubic polynomial in coordinates that run from
// -1 to 1 over the whole picture.
struct BackgroundModel {
  static constexpr int kTerms = 10;                      // x^i y^j, i + j <= 3
  std::vector<std::array<double, kTerms>> coefficients;  // one row a channel
  std::vector<double> scatter;                           // robust standard deviation a channel
};

// Fits the background to `image` (CV_32FC1 or CV_32FC3), by
// reweighted least squares that discounts whatever does not follow it. `ignore` (CV_8UC1, may be
// empty) is non-zero where pixels do not count.
[[nodiscard]] BackgroundModel FitBackground(const cv::Mat& image, const cv::Mat& ignore);

// What `image` (CV_32FC1) shows above the background, below it negative.
[[nodiscard]] cv::Mat AboveBackground(const cv::Mat& image, const BackgroundModel& background);

// Distance of each pixel from the background in units of its scatter, CV_32FC1.
[[nodiscard]] cv::Mat DistanceFromBackground(const cv::Mat& image,
                                             const BackgroundModel& background);

// The same for BGR pixels (CV_32FC3, any light scale), blind to shadows: a shadow is the background
// times a factor below one, so only what is left after the best such factor counts. Grey metal on
// grey paper vanishes with the shadows.
[[nodiscard]] cv::Mat DistanceFromShadedBackground(const cv::Mat& bgr,
                                                   const BackgroundModel& background);

}  // namespace bladecurve
