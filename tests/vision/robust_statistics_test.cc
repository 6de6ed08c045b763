// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/robust_statistics.h"

#include <gtest/gtest.h>

namespace bladecurve {
namespace {

TEST(MedianOfFarthestThird, SeesWhatOnlyOnePartDoes) {
  EXPECT_EQ(MedianOfFarthestThird({0, 0, 0, 0, 1, 0, -2, -3, -2.5}), -2.5);
  EXPECT_EQ(MedianOfFarthestThird({4, 4, 4, 0, 0, 0, -2, -2, -2}), 4);
  EXPECT_EQ(MedianOfFarthestThird({0, 9, 0, 0, -9, 0, 0, 9, 0}), 0) << "single strays";
}

TEST(MedianOfFarthestThird, IsTheMedianOfFewValues) {
  EXPECT_EQ(MedianOfFarthestThird({}), 0);
  EXPECT_EQ(MedianOfFarthestThird({1, 1, 1, 5, 5}), 1);
}

}  // namespace
}  // namespace bladecurve
