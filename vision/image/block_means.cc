// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/block_means.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "vision/parallel.h"

namespace bladecurve {

namespace {

void AddPixels(const uchar* pixels, std::size_t count, std::uint16_t* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + pixels[i]);
}

// The means of blocks whose columns are summed; a factor that the compiler knows, a constant's
// type, is twice as fast.
template <typename Factor>
void MeansOfBlocks(const std::uint16_t* sums, Factor factor, int count, float* out) {
  const float share = 1.0F / static_cast<float>(factor * factor);
  for (int i = 0; i < count; ++i, sums += factor)
    out[i] = share * static_cast<float>(std::accumulate(sums, sums + factor, 0));
}

template <int kFactor>
using Known = std::integral_constant<int, kFactor>;

void MeansOfAllBlocks(const std::uint16_t* sums, int factor, int count, float* out) {
  switch (factor) {  // the usual ones, of photographs of up to 7.5 thousand pixels
    case 2:
      return MeansOfBlocks(sums, Known<2>(), count, out);
    case 3:
      return MeansOfBlocks(sums, Known<3>(), count, out);
    case 4:
      return MeansOfBlocks(sums, Known<4>(), count, out);
    case 5:
      return MeansOfBlocks(sums, Known<5>(), count, out);
    case 6:
      return MeansOfBlocks(sums, Known<6>(), count, out);
    case 7:
      return MeansOfBlocks(sums, Known<7>(), count, out);
    default:
      return MeansOfBlocks(sums, factor, count, out);
  }
}

// Rows [first, last) of the means.
void FillRows(const cv::Mat& grey, int factor, int first, int last, cv::Mat* means) {
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(means->cols * factor));
  for (int row = first; row < last; ++row) {
    std::fill(sums.begin(), sums.end(), std::uint16_t{0});
    for (int k = 0; k < factor; ++k)
      AddPixels(grey.ptr<uchar>(row * factor + k), sums.size(), sums.data());
    MeansOfAllBlocks(sums.data(), factor, means->cols, means->ptr<float>(row));
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
