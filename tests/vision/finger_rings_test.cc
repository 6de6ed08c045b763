// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/finger_rings.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

constexpr int kBetweenPx = 120;

// Rings in a row, slanted and joined by shanks; axes of their holes, px.
cv::Mat Rings(int count, const cv::Size& axes, int wall_px = 8) {
  cv::Mat mask = cv::Mat::zeros(400, 640, CV_8UC1);
  for (int k = 0; k < count; ++k) {
    const cv::Point center(80 + k * kBetweenPx, 120);
    const cv::Size middle = axes / 2 + cv::Size(wall_px / 2, wall_px / 2);
    cv::ellipse(mask, center, middle, 20, 0, 360, 255, wall_px);
    cv::line(mask, center + cv::Point(0, middle.height), center + cv::Point(40, 240), 255, 10);
  }
  return mask;
}

TEST(CountFingerRings, CountsRoundAndOvalOnes) {
  for (const cv::Size& axes : {cv::Size(50, 50), cv::Size(60, 40)}) {
    for (const int count : {0, 1, 2, 4}) EXPECT_EQ(CountFingerRings(Rings(count, axes)), count);
  }
}

TEST(CountFingerRings, LeavesOutHolesThatAreNoRings) {
  EXPECT_EQ(CountFingerRings(Rings(3, {70, 30})), 0) << "too long";
  EXPECT_EQ(CountFingerRings(Rings(3, {14, 14})), 0) << "too small";
  cv::Mat boxes = cv::Mat::zeros(400, 640, CV_8UC1), plate = boxes.clone();
  for (int k = 0; k < 3; ++k) {
    const cv::Point corner(60 + k * kBetweenPx, 100);
    cv::rectangle(boxes, {corner, cv::Size(56, 56)}, 255, 8);
    cv::rectangle(plate, {corner - cv::Point(40, 60), cv::Size(150, 250)}, 255, cv::FILLED);
  }
  for (int k = 0; k < 3; ++k) cv::circle(plate, {90 + k * kBetweenPx, 180}, 25, 0, cv::FILLED);
  EXPECT_EQ(CountFingerRings(boxes), 0);
  EXPECT_EQ(CountFingerRings(plate), 0) << "without a wall about them";
}

TEST(CountFingerRings, CountsTheTwoLinesOfARoundOneOnce) {
  cv::Mat mask = Rings(2, {70, 70}, 5);
  for (const int x : {80, 80 + kBetweenPx}) cv::circle(mask, {x, 120}, 26, 255, 3);
  EXPECT_EQ(CountFingerRings(mask), 2);
}

TEST(CountFingerRings, CountsThoseThatAreAlike) {
  cv::Mat mask = Rings(2, {60, 60});
  cv::circle(mask, {500, 120}, 20, 255, 8);
  EXPECT_EQ(CountFingerRings(mask), 2);
}

}  // namespace
}  // namespace bladecurve
