// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_steepest.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "screw_images.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

cv::Mat Smooth(const cv::Mat& grey) {
  cv::Mat smooth;
  grey.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, 0.8);
  return smooth;
}

// A groove on the left, a bright ring on the right.
cv::Mat GrooveAndRing(HeadSpec head) {
  head.groove = -0.1;
  cv::Mat grey = RenderHead(head);
  head.groove = 0.1;
  const cv::Rect right(static_cast<int>(head.center_px.x()), 0, head.side_px / 2, head.side_px);
  RenderHead(head)(right).copyTo(grey(right));
  return grey;
}

TEST(FindSteepest, FindsTheRimWhateverItLooksLike) {
  constexpr double kRadius = 28;
  HeadSpec head;
  head.semi_major_px = head.semi_minor_px = kRadius;
  const SteepestCircle steepest = FindSteepest(
      Smooth(GrooveAndRing(head)), head.center_px + Vector2d(0.15, -0.1) * kRadius, 1.1 * kRadius);
  EXPECT_GT(steepest.share, 0.85);
  EXPECT_GT(steepest.third_share, 0.6);
  EXPECT_LT((steepest.center - head.center_px).norm(), 0.06 * kRadius);
  EXPECT_NEAR(steepest.radius_px, kRadius, 0.08 * kRadius);
}

TEST(FindSteepest, SeesWhichThirdIsMissing) {
  HeadSpec head;
  cv::Mat grey = GrooveAndRing(head);
  const int y = static_cast<int>(head.center_px.y()) + 8;
  grey.rowRange(y, grey.rows).setTo(cv::Scalar::all(grey.at<uchar>(0, 0)));
  const SteepestCircle steepest = FindSteepest(Smooth(grey), head.center_px, head.semi_major_px);
  EXPECT_LT(steepest.third_share, 0.5);
  EXPECT_GT(steepest.share, 0.5);
}

TEST(FindSteepest, GrainAndNoiseLieOnNoCircle) {
  constexpr int kPlaces = 50;
  constexpr double kUsual = 0.65, kMost = 0.85;
  HeadSpec plate;
  plate.brushed = 0.1;
  const cv::Mat smooth = Smooth(RenderHead(plate));
  Draws draws(3);
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vector2d center(draws.Uniform(40, 160), draws.Uniform(40, 160));
    const double share = FindSteepest(smooth, center, draws.Uniform(7, 20)).share;
    EXPECT_LT(share, kMost);
    sum += share;
  }
  EXPECT_LT(sum / kPlaces, kUsual);
}

TEST(FindSteepest, AFlatPictureHasNone) {
  const cv::Mat flat(90, 90, CV_32F, cv::Scalar(128));
  EXPECT_EQ(FindSteepest(flat, {45, 45}, 12).share, 0);
  EXPECT_EQ(FindSteepest(flat, {-300, 45}, 12).share, 0);  // beyond its border, too
}

}  // namespace
}  // namespace bladecurve
