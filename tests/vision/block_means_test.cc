// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/block_means.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>
#include <stdexcept>

namespace bladecurve {
namespace {

cv::Mat Noise(int rows, int columns, std::uint32_t seed) {
  std::mt19937 random(seed);
  cv::Mat picture(rows, columns, CV_8UC1);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      picture.at<uchar>(row, column) = static_cast<uchar>(random() % 256);
  }
  return picture;
}

TEST(BlockMeans, EqualTheMeansOfTheBlocks) {
  constexpr double kRounding = 255 * 1e-6;  // of single precision
  const cv::Mat whole = Noise(300, 271, 1);
  const cv::Mat part = whole(cv::Rect(3, 5, 260, 290));  // rows that do not follow each other
  for (const int factor : {1, 2, 3, 4, 5, 6, 7, 17}) {
    const cv::Mat means = BlockMeans(part, factor);
    ASSERT_EQ(means.size(), cv::Size(260 / factor, 290 / factor)) << factor;
    for (int row = 0; row < means.rows; ++row) {
      for (int column = 0; column < means.cols; ++column) {
        const cv::Rect block(column * factor, row * factor, factor, factor);
        EXPECT_NEAR(means.at<float>(row, column), cv::mean(part(block))[0], kRounding)
            << "factor " << factor << " row " << row << " column " << column;
      }
    }
  }
}

TEST(BlockMeans, HoldTheLargestBlockOfWhite) {
  const cv::Mat white(257, 257, CV_8UC1, cv::Scalar(255));
  EXPECT_FLOAT_EQ(BlockMeans(white, 257).at<float>(0, 0), 255);
}

TEST(BlockMeans, RefuseFactorsOutOfRange) {
  const cv::Mat picture = Noise(4, 4, 2);
  for (const int factor : {-1, 0, 258}) {
    EXPECT_THROW((void)BlockMeans(picture, factor), std::invalid_argument) << factor;
  }
}

TEST(BlockMeans, PicturesSmallerThanABlockGiveNone) {
  EXPECT_TRUE(BlockMeans(Noise(5, 9, 3), 6).empty());
  EXPECT_TRUE(BlockMeans(Noise(9, 5, 3), 6).empty());
}

}  // namespace
}  // namespace bladecurve
