// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/block_means.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "vision/parallel.h"

namespace bladecurve {

namespace {

void AddPixels(const uchar* pixels, std::size_t count, std::uint16_t* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + pixels[i]);
}

// share times the sum of each block of so many; a number the compiler knows is twice as fast.
template <int kFactor>
void ScaleBlocks(const std::uint16_t* sums, int count, float share, float* out) {
  for (int i = 0; i < count; ++i, sums += kFactor)
    out[i] = share * static_cast<float>(std::accumulate(sums, sums + kFactor, 0));
}

void ScaleBlocks(const std::uint16_t* sums, int factor, int count, float* out) {
  const float share = 1.0F / static_cast<float>(factor * factor);
  switch (factor) {  // the usual ones, of photographs of up to 7.5 thousand pixels
    case 2:
      return ScaleBlocks<2>(sums, count, share, out);
    case 3:
      return ScaleBlocks<3>(sums, count, share, out);
    case 4:
      return ScaleBlocks<4>(sums, count, share, out);
    case 5:
      return ScaleBlocks<5>(sums, count, share, out);
    case 6:
      return ScaleBlocks<6>(sums, count, share, out);
    case 7:
      return ScaleBlocks<7>(sums, count, share, out);
    default:
      break;
  }
  for (int i = 0; i < count; ++i, sums += factor)
    out[i] = share * static_cast<float>(std::accumulate(sums, sums + factor, 0));
}

// Rows [first, last) of the means.
void FillRows(const cv::Mat& grey, int factor, int first, int last, cv::Mat* means) {
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(means->cols * factor));
  for (int row = first; row < last; ++row) {
    std::fill(sums.begin(), sums.end(), std::uint16_t{0});
    for (int k = 0; k < factor; ++k)
      AddPixels(grey.ptr<uchar>(row * factor + k), sums.size(), sums.data());
    ScaleBlocks(sums.data(), factor, means->cols, means->ptr<float>(row));
  }
}

}  // namespace

cv::Mat BlockMeans(const cv::Mat& grey, int factor) {
  constexpr int kLargest = 257;  // so many pixels of 255 are the most that 16 bits hold
  if (factor < 1 || factor > kLargest) {
    throw std::invalid_argument("BlockMeans: factor is " + std::to_string(factor) +
                                "; it must be 1 to 257");
  }
  cv::Mat means;
  if (factor == 1) {
    grey.convertTo(means, CV_32F);
    return means;
  }
  means.create(grey.rows / factor, grey.cols / factor, CV_32FC1);
  ParallelForBands(means.rows,
                   [&](int first, int last) { FillRows(grey, factor, first, last, &means); });
  return means;
}

}  // namespace bladecurve
