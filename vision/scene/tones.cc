// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/tones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

constexpr int kLightest = 100;                // of either sign
constexpr std::size_t kBins = 2 * kLightest;  // of 1

using Histogram = std::array<float, kBins>;

Histogram HistogramWithin(const cv::Mat& lightness, const cv::Mat& things) {
  constexpr int kStep = 2, kBorderPx = 2;
  constexpr double kBroad = 1.5;  // lightness
  Histogram counts{};
  for (int y = kBorderPx; y + kBorderPx < things.rows; y += kStep) {
    const float* light = lightness.ptr<float>(y);
    const uchar* here = things.ptr<uchar>(y);
    const uchar* above = things.ptr<uchar>(y - kBorderPx);
    const uchar* below = things.ptr<uchar>(y + kBorderPx);
    for (int x = kBorderPx; x + kBorderPx < things.cols; x += kStep) {
      if (!here[x] || !here[x - kBorderPx] || !here[x + kBorderPx] || !above[x] || !below[x])
        continue;
      const int bin = kLightest + static_cast<int>(std::floor(light[x]));
      ++counts[static_cast<std::size_t>(std::clamp(bin, 0, static_cast<int>(kBins) - 1))];
    }
  }
  cv::Mat row(1, static_cast<int>(kBins), CV_32FC1, counts.data());
  cv::GaussianBlur(row, row, {}, kBroad, kBroad, cv::BORDER_CONSTANT);
  return counts;
}

double LightnessOf(std::size_t bin) { return static_cast<double>(bin) - kLightest + 0.5; }

Tones ApartIn(const Histogram& counts) {
  constexpr float kLeast = 0.02F;  // of the highest peak
  constexpr float kMerges = 0.6F;  // of the lower peak is no valley
  const float highest = *std::max_element(counts.begin(), counts.end());
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < kBins; ++i) {
    if (counts[i] >= counts[i - 1] && counts[i] > counts[i + 1] && counts[i] > kLeast * highest)
      peaks.push_back(i);
  }
  const auto valley = [&](std::size_t k) {
    return static_cast<std::size_t>(
        std::min_element(counts.begin() + static_cast<long>(peaks[k]),
                         counts.begin() + static_cast<long>(peaks[k + 1])) -
        counts.begin());
  };
  const auto depth = [&](std::size_t k) {
    return counts[valley(k)] / std::min(counts[peaks[k]], counts[peaks[k + 1]]);
  };
  while (peaks.size() > 1) {
    std::size_t flattest = 0;
    for (std::size_t k = 1; k + 1 < peaks.size(); ++k) {
      if (depth(k) > depth(flattest)) flattest = k;
    }
    if (depth(flattest) < kMerges) break;
    const bool first_lower = counts[peaks[flattest]] < counts[peaks[flattest + 1]];
    peaks.erase(peaks.begin() + static_cast<long>(flattest + (first_lower ? 0 : 1)));
  }
  Tones tones;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    tones.peaks.push_back(LightnessOf(peaks[k]));
    if (k + 1 < peaks.size()) tones.valleys.push_back(LightnessOf(valley(k)));
  }
  return tones;
}

}  // namespace

Tones TonesOf(const cv::Mat& lightness, const cv::Mat& things) {
  return ApartIn(HistogramWithin(lightness, things));
}

}  // namespace bladecurve
