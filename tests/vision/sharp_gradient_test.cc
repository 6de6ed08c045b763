// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/sharp_gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace bladecurve {
namespace {

// Lab with grain, and a thing that is darker and redder.
cv::Mat ThingOnGround(const cv::Size& size) {
  cv::Mat lab(size, CV_32FC3, cv::Scalar(70, 0, 0)), grain(size, CV_32FC3);
  cv::rectangle(lab, {size.width / 3, 0, 40, size.height}, {30, 20, 5}, cv::FILLED);
  cv::RNG random(1);
  random.fill(grain, cv::RNG::NORMAL, 0, 2);
  return lab + grain;
}

// Bands are shared out to threads; where they meet depends on the picture's height.
TEST(SharpGradient, DoesNotTellWhereItsBandsMeet) {
  constexpr int kAbove = 50, kBelow = 60, kReach = 15;
  const cv::Mat lab = ThingOnGround({120, 500});
  const cv::Rect part(0, kAbove, lab.cols, lab.rows - kAbove - kBelow);
  const cv::Rect inner(0, kReach, part.width, part.height - 2 * kReach);
  const cv::Mat of_whole = SharpGradient(lab)(part), of_part = SharpGradient(lab(part).clone());
  EXPECT_EQ(cv::norm(of_whole(inner), of_part(inner), cv::NORM_INF), 0);
}

TEST(SharpGradient, StandsOutAtAStepAndNotOnARamp) {
  constexpr int kSide = 200, kStepAt = 60, kRampFrom = 100, kRampTo = 160;
  cv::Mat lab(kSide, kSide, CV_32FC3);
  for (int x = 0; x < kSide; ++x) {
    const double ramp = std::clamp<double>(x - kRampFrom, 0, kRampTo - kRampFrom);
    lab.col(x).setTo(cv::Scalar((x < kStepAt ? 20 : 60) + 0.5 * ramp, 0, 0));
  }
  const cv::Mat sharp = SharpGradient(lab);
  EXPECT_GT(sharp.at<float>(kSide / 2, kStepAt), 5);
  EXPECT_EQ(sharp.at<float>(kSide / 2, (kRampFrom + kRampTo) / 2), 0);
}

TEST(Walls, AreInUnitsOfTheUsualGradient) {
  for (const cv::Size& size : {cv::Size(120, 301), cv::Size(121, 301)}) {
    const cv::Mat walls = Walls(SharpGradient(ThingOnGround(size)), 3, {});
    std::vector<float> values(walls.begin<float>(), walls.end<float>());
    std::sort(values.begin(), values.end());
    EXPECT_FLOAT_EQ(values[values.size() / 2], 1);
  }
}

}  // namespace
}  // namespace bladecurve
