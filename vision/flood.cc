// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/flood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
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

// Length of the gradient over all three channels at a smoothing of `sigma` px, Lab units per px.
cv::Mat GradientLength(const cv::Mat& lab, double sigma) {
  cv::Mat smooth;
  cv::GaussianBlur(lab, smooth, {}, sigma);
  cv::Mat x;
  cv::Mat y;
  cv::Scharr(smooth, x, CV_32F, 1, 0, 1.0 / 32);
  cv::Scharr(smooth, y, CV_32F, 0, 1, 1.0 / 32);
  cv::Mat length(lab.size(), CV_32FC1);
  for (int row = 0; row < lab.rows; ++row) {
    const cv::Vec3f* gx = x.ptr<cv::Vec3f>(row);
    const cv::Vec3f* gy = y.ptr<cv::Vec3f>(row);
    float* out = length.ptr<float>(row);
    for (int col = 0; col < lab.cols; ++col)
      out[col] = std::sqrt(gx[col].dot(gx[col]) + gy[col].dot(gy[col]));
  }
  return length;
}

float UsualGradient(const cv::Mat& walls) {
  constexpr float kRounding = 0.1f;  // Lab units per px: what an even, noiseless ground has
  std::vector<float> values(walls.begin<float>(), walls.end<float>());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(*middle, kRounding);
}

// Where the flood starts: pixels of the frame that look like the background.
std::vector<int> Springs(const cv::Mat& distance) {
  constexpr float kBackground = 6;  // in units of its scatter; metal that is cut off has more
  std::vector<int> springs;
  const auto add = [&](int row, int col) {
    if (distance.at<float>(row, col) < kBackground) springs.push_back(row * distance.cols + col);
  };
  for (int col = 0; col < distance.cols; ++col) {
    add(0, col);
    add(distance.rows - 1, col);
  }
  for (int row = 1; row + 1 < distance.rows; ++row) {
    add(row, 0);
    add(row, distance.cols - 1);
  }
  return springs;
}

// Pixels are visited in the order of the level at which they are reached.
cv::Mat Flood(const cv::Mat& bins, const std::vector<int>& springs) {
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
  for (const int pixel : springs) reach(pixel, 0);
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

cv::Mat SharpGradient(const cv::Mat& lab) {
  constexpr double kFine = 0.8;  // px: below it is noise and JPEG's ringing
  constexpr double kCoarse = 2.5;
  constexpr double kSoft = 1.2;  // a ramp that loses less than a sixth is no wall; a step loses two
                                 // thirds
  return cv::max(GradientLength(lab, kFine) - kSoft * GradientLength(lab, kCoarse), 0);
}

cv::Mat FloodLevels(const cv::Mat& sharp_gradient,
                    const cv::Mat& distance,
                    const cv::Mat& ignore,
                    int closed_px) {
  cv::Mat walls;
  cv::morphologyEx(sharp_gradient,
                   walls,
                   cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {closed_px, closed_px}));
  const float usual = UsualGradient(walls);
  cv::Mat bins(walls.size(), CV_8UC1);
  for (int row = 0; row < walls.rows; ++row) {
    const float* wall = walls.ptr<float>(row);
    uchar* bin = bins.ptr(row);
    for (int col = 0; col < walls.cols; ++col) bin[col] = BinOfLevel(wall[col] / usual);
  }
  if (!ignore.empty()) bins.setTo(0, ignore);
  const cv::Mat reached = Flood(bins, Springs(distance));
  cv::Mat levels(walls.size(), CV_32FC1);
  for (int row = 0; row < walls.rows; ++row) {
    const uchar* bin = reached.ptr(row);
    float* level = levels.ptr<float>(row);
    for (int col = 0; col < walls.cols; ++col) level[col] = LevelOfBin(bin[col]);
  }
  if (!ignore.empty()) levels.setTo(0, ignore);
  return levels;
}

}  // namespace bladecurve
