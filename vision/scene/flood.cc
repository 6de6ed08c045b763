// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/flood.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "vision/scene/pixel_neighbours.h"
#include "vision/scene/sharp_gradient.h"

namespace bladecurve {
namespace {

// Pixels are visited in the order of the level at which they are reached.
cv::Mat Flood(const cv::Mat& bins, const cv::Mat& ground) {
  constexpr uchar kDry = 255;
  cv::Mat reached(bins.size(), CV_8UC1, cv::Scalar(kDry));
  uchar* level = reached.ptr();
  const uchar* wall = bins.ptr();
  std::array<std::vector<int>, kWallBins> waiting;
  const auto reach = [&](int pixel, int from) {
    if (level[pixel] != kDry) return;
    level[pixel] = static_cast<uchar>(std::max<int>(from, wall[pixel]));
    waiting[level[pixel]].push_back(pixel);
  };
  const int pixels = static_cast<int>(bins.total());
  for (int pixel = 0; pixel < pixels; ++pixel) {
    if (ground.ptr()[pixel] != 0) reach(pixel, 0);
  }
  for (int bin = 0; bin < kWallBins; ++bin) {
    std::vector<int>& now = waiting[static_cast<std::size_t>(bin)];
    while (!now.empty()) {
      const int pixel = now.back();
      now.pop_back();
      ForNeighbours(bins.size(), pixel, [&](int neighbour) { reach(neighbour, bin); });
    }
  }
  return reached;
}

}  // namespace

cv::Mat FloodLevels(const cv::Mat& walls, const cv::Mat& ground) {
  const cv::Mat reached = Flood(WallBins(walls), ground);
  cv::Mat wall_of_bin(1, 256, CV_32FC1);
  for (int bin = 0; bin < wall_of_bin.cols; ++bin) wall_of_bin.at<float>(bin) = WallOfBin(bin);
  cv::Mat levels;
  cv::LUT(reached, wall_of_bin, levels);
  return levels;
}

}  // namespace bladecurve
