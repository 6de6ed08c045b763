// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/sharp_gradient.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/image/disk.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

constexpr float kBinsPerOctave = 12, kLowestWall = 0.25F;  // of WallBins

// Length of the gradient over all three channels at a smoothing of `sigma` px, Lab units per px, in
// the rows [first, last).
cv::Mat GradientLength(const cv::Mat& lab, double sigma, int first, int last) {
  const int above = std::min(first, 1), below = std::min(lab.rows - last, 1);  // rows that count
  cv::Mat smooth, x, y;
  cv::GaussianBlur(lab.rowRange(first - above, last + below), smooth, {}, sigma);
  const cv::Mat rows = smooth.rowRange(above, smooth.rows - below);
  cv::Scharr(rows, x, CV_32F, 1, 0, 1.0 / 32);
  cv::Scharr(rows, y, CV_32F, 0, 1, 1.0 / 32);
  cv::Mat length(rows.size(), CV_32FC1);
  for (int row = 0; row < length.rows; ++row) {
    const cv::Vec3f* gx = x.ptr<cv::Vec3f>(row);
    const cv::Vec3f* gy = y.ptr<cv::Vec3f>(row);
    float* out = length.ptr<float>(row);
    for (int col = 0; col < length.cols; ++col)
      out[col] = std::sqrt(gx[col].dot(gx[col]) + gy[col].dot(gy[col]));
  }
  return length;
}

// Of values in one piece of memory, none negative, as std::nth_element would put it in the middle,
// but quicker: such floats are in the order of their bits.
float Middle(const cv::Mat& values) {
  constexpr int kLowBits = 16;
  std::vector<int> counts(std::size_t{1} << kLowBits);
  const auto high = [](float value) { return std::bit_cast<std::uint32_t>(value) >> kLowBits; };
  const float *const first = values.ptr<float>(), *const end = first + values.total();
  for (const float* value = first; value != end; ++value) ++counts[high(*value)];
  auto before = static_cast<std::ptrdiff_t>(values.total() / 2);
  std::uint32_t bin = 0;
  for (; before >= counts[bin]; ++bin) before -= counts[bin];
  std::vector<float> alike;
  std::copy_if(first, end, std::back_inserter(alike), [&](float v) { return high(v) == bin; });
  std::nth_element(alike.begin(), alike.begin() + before, alike.end());
  return alike[static_cast<std::size_t>(before)];
}

// In units of its median.
cv::Mat InUsualUnits(const cv::Mat& relief) {
  constexpr float kRounding = 0.1F;  // Lab units per px: what an even, noiseless ground has
  return relief / std::max(Middle(relief), kRounding);
}

}  // namespace

cv::Mat SharpGradient(const cv::Mat& lab) {
  constexpr double kFine = 0.8;  // px: below it is noise and JPEG's ringing
  constexpr double kCoarse = 2.5;
  constexpr double kSoft = 1.2;  // a ramp that loses less than a sixth is no wall; a step loses two
                                 // thirds
  cv::Mat sharp(lab.size(), CV_32FC1);
  ParallelForBands(lab.rows, [&](int first, int last) {
    const cv::Mat ramps = kSoft * GradientLength(lab, kCoarse, first, last);
    cv::Mat rows = sharp.rowRange(first, last);
    cv::max(GradientLength(lab, kFine, first, last) - ramps, 0, rows);
  });
  return sharp;
}

cv::Mat Walls(const cv::Mat& sharp_gradient, int closed_px, const cv::Mat& ignore) {
  cv::Mat closed;
  cv::morphologyEx(sharp_gradient, closed, cv::MORPH_CLOSE, Disk(closed_px));
  cv::Mat walls = InUsualUnits(closed);
  if (!ignore.empty()) walls.setTo(0, ignore);
  return walls;
}

cv::Mat WallBins(const cv::Mat& walls) {
  cv::Mat logarithm;
  cv::log(cv::max(walls, kLowestWall), logarithm);
  cv::Mat bins;
  logarithm.convertTo(
      bins, CV_8U, kBinsPerOctave / std::numbers::ln2, -kBinsPerOctave * std::log2(kLowestWall));
  return cv::min(bins, kWallBins - 1);
}

float WallOfBin(int bin) {
  return kLowestWall * std::exp2(static_cast<float>(bin) / kBinsPerOctave);
}

cv::Mat GroundAtFrame(const cv::Mat& distance) {
  constexpr float kBackground = 6;  // in units of its scatter; metal that is cut off has more
  cv::Mat ground = distance < kBackground;
  ground(cv::Rect(1, 1, ground.cols - 2, ground.rows - 2)).setTo(0);
  return ground;
}

}  // namespace bladecurve
