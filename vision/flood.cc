// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/flood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bladecurve {
namespace {

// Gradients are sorted into bins, twelve to the octave, from a quarter of the usual gradient up.
constexpr int kBins = 128;
constexpr float kBinsPerOctave = 12;
constexpr float kLowestLevel = 0.25f;

float LevelOfBin(int bin) {
  return kLowestLevel * std::exp2(static_cast<float>(bin) / kBinsPerOctave);
}

uchar BinOfLevel(float level) {
  const float bin = kBinsPerOctave * std::log2(std::max(level, kLowestLevel) / kLowestLevel);
  return cv::saturate_cast<uchar>(std::min(std::lround(bin), static_cast<long>(kBins) - 1));
}

// Pixels are visited in the order of the level at which they are reached.
cv::Mat Flood(const cv::Mat& bins, const cv::Mat& ground) {
  constexpr uchar kDry = 255;
  cv::Mat reached(bins.size(), CV_8UC1, cv::Scalar(kDry));
  uchar* level = reached.ptr();
  const uchar* wall = bins.ptr();
  std::array<std::vector<int>, kBins> waiting;
  const auto reach = [&](int pixel, int from) {
    if (level[pixel] != kDry) return;
    level[pixel] = static_cast<uchar>(std::max<int>(from, wall[pixel]));
    waiting[level[pixel]].push_back(pixel);
  };
  const int pixels = static_cast<int>(bins.total());
  for (int pixel = 0; pixel < pixels; ++pixel) {
    if (ground.ptr()[pixel] != 0) reach(pixel, 0);
  }
  const int cols = bins.cols;
  const int last_row = (bins.rows - 1) * cols;
  for (int bin = 0; bin < kBins; ++bin) {
    std::vector<int>& now = waiting[static_cast<std::size_t>(bin)];
    while (!now.empty()) {
      const int pixel = now.back();
      now.pop_back();
      if (pixel % cols > 0) reach(pixel - 1, bin);
      if (pixel % cols < cols - 1) reach(pixel + 1, bin);
      if (pixel >= cols) reach(pixel - cols, bin);
      if (pixel < last_row) reach(pixel + cols, bin);
    }
  }
  return reached;
}

}  // namespace

cv::Mat FloodLevels(const cv::Mat& walls, const cv::Mat& ground) {
  cv::Mat bins(walls.size(), CV_8UC1);
  for (int row = 0; row < walls.rows; ++row) {
    const float* wall = walls.ptr<float>(row);
    uchar* bin = bins.ptr(row);
    for (int col = 0; col < walls.cols; ++col) bin[col] = BinOfLevel(wall[col]);
  }
  const cv::Mat reached = Flood(bins, ground);
  cv::Mat levels(walls.size(), CV_32FC1);
  for (int row = 0; row < walls.rows; ++row) {
    const uchar* bin = reached.ptr(row);
    float* level = levels.ptr<float>(row);
    for (int col = 0; col < walls.cols; ++col) level[col] = LevelOfBin(bin[col]);
  }
  return levels;
}

}  // namespace bladecurve
