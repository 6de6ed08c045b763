// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

inline constexpr int kDictionarySize = 50;  // ids 0 to 49

// A marker as OpenCV sees it: to about a pixel.
struct RoughMarker {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // printed order, clockwise from the top left
};

// DICT_4X4_50 markers in a CV_8UC1 picture, by OpenCV's aruco (up to 4.6) or objdetect (from 4.7)
// module.
[[nodiscard]] std::vector<RoughMarker> DetectMarkers(const cv::Mat& grey);

// The printed pattern: 4 x 4 cells, row by row from the top left, true where paper shows.
[[nodiscard]] std::array<bool, 16> MarkerCells(int id);

}  // namespace bladecurve
