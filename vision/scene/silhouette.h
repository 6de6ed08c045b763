// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

// One connected thing in the picture: its outer contour, and its area with holes (rings) filled.
struct Silhouette {
  std::vector<cv::Point> contour;  // closed, every pixel, clockwise as seen with y down
  cv::Mat filled;                  // CV_8UC1, the size of the mask
  double area_px = 0;              // of `filled`
};

// Pixels further than `threshold` from the background, specks and pinholes removed. CV_8UC1, 0 or
// 255.
[[nodiscard]] cv::Mat MaskAbove(const cv::Mat& distance, double threshold);

// The connected things in `mask` that are long enough to be scissors, largest first, at most
// `most`.
[[nodiscard]] std::vector<Silhouette> FindSilhouettes(const cv::Mat& mask, int most);

// Of `things`, the one that covers a place, its holes included; nullptr if none does.
[[nodiscard]] const Silhouette* ThingAt(const std::vector<Silhouette>& things,
                                        const Eigen::Vector2d& at_px);

}  // namespace bladecurve
