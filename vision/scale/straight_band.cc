// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/straight_band.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kBinPx = 8;  // pieces along the edge that are kept or left out as one

}  // namespace

StraightEdgeBand MakeBand(const StraightEdgeGuess& guess, double half_width) {
  const Vector2d chord = guess.to_px - guess.from_px;
  const Vector2d direction = chord.normalized();
  return {0.5 * (guess.from_px + guess.to_px),
          direction,
          {-direction.y(), direction.x()},
          chord.norm(),
          half_width,
          guess.bow_px};
}

double Sagitta(const StraightEdgeBand& band, double along) {
  const double x = 2 * along / band.length;
  return band.bow * (1 - x * x);
}

std::vector<BandSample> Collect(const LinearPicture& picture,
                                const StraightEdgeBand& band,
                                int stride) {
  const cv::Mat& grey = picture.grey;
  const int major = std::abs(band.direction.x()) >= std::abs(band.direction.y()) ? 0 : 1,
            minor = 1 - major;
  const std::array<int, 2> size = {grey.cols, grey.rows};
  const double steep = band.direction[minor] / band.direction[major];
  const double reach = (band.half_width + std::abs(band.bow)) / std::abs(band.direction[major]) + 1;
  const double extent = 0.5 * band.length * std::abs(band.direction[major]) + band.half_width;
  const int first = std::max(0, static_cast<int>(std::ceil(band.middle[major] - extent)));
  const int last = std::min(size[static_cast<size_t>(major)] - 1,
                            static_cast<int>(std::floor(band.middle[major] + extent)));
  std::vector<BandSample> samples;
  for (int a = first; a <= last; a += stride) {
    const double centre = band.middle[minor] + steep * (a - band.middle[major]);
    const int low = std::max(0, static_cast<int>(std::ceil(centre - reach)));
    const int high = std::min(size[static_cast<size_t>(minor)] - 1,
                              static_cast<int>(std::floor(centre + reach)));
    for (int b = low; b <= high; ++b) {
      const Vector2d offset = (major == 0 ? Vector2d(a, b) : Vector2d(b, a)) - band.middle;
      const double along = offset.dot(band.direction);
      const double across = offset.dot(band.normal) - Sagitta(band, along);
      if (std::abs(along) > 0.5 * band.length || std::abs(across) > band.half_width) continue;
      const uchar value = major == 0 ? grey.at<uchar>(b, a) : grey.at<uchar>(a, b);
      samples.push_back({across,
                         along,
                         picture.tone.linear[value],
                         static_cast<int>((along + 0.5 * band.length) / kBinPx)});
    }
  }
  return samples;
}

size_t BinCount(const StraightEdgeBand& band) {
  return static_cast<size_t>(band.length / kBinPx) + 2;
}

}  // namespace bladecurve
