// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/sharp_gradient.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/image/disk.h"
#include "vision/image/smoothed.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

constexpr float kBinsPerOctave = 12, kLowestWall = 0.25F;  // of WallBins

// Length of the gradient over all three channels at a smoothing of `sigma` px, Lab units per px.
cv::Mat GradientLength(const cv::Mat& lab, double sigma) {
  const cv::Mat smooth = Smoothed(lab, sigma);
  cv::Mat length(lab.size(), CV_32FC1);
  ParallelForBands(lab.rows, [&](int first, int last) {
    cv::Mat x;
    cv::Mat y;
    cv::Scharr(smooth.rowRange(first, last), x, CV_32F, 1, 0, 1.0 / 32);
    cv::Scharr(smooth.rowRange(first, last), y, CV_32F, 0, 1, 1.0 / 32);
    for (int row = first; row < last; ++row) {
      const cv::Vec3f* gx = x.ptr<cv::Vec3f>(row - first);
      const cv::Vec3f* gy = y.ptr<cv::Vec3f>(row - first);
      float* out = length.ptr<float>(row);
      for (int col = 0; col < lab.cols; ++col)
        out[col] = std::sqrt(gx[col].dot(gx[col]) + gy[col].dot(gy[col]));
    }
  });
  return length;
}

// In units of its median.
cv::Mat InUsualUnits(const cv::Mat& relief) {
  constexpr float kRounding = 0.1F;  // Lab units per px: what an even, noiseless ground has
  std::vector<float> values(relief.begin<float>(), relief.end<float>());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return relief / std::max(*middle, kRounding);
}

}  // namespace

cv::Mat SharpGradient(const cv::Mat& lab) {
  constexpr double kFine = 0.8;  // px: below it is noise and JPEG's ringing
  constexpr double kCoarse = 2.5;
  constexpr double kSoft = 1.2;  // a ramp that loses less than a sixth is no wall; a step loses two
                                 // thirds
  return cv::max(GradientLength(lab, kFine) - kSoft * GradientLength(lab, kCoarse), 0);
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
