// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/covered_handles.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/scene/limbs.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kCrotchX = 300, kRow = 200;  // px; the tips are on the right

// Two blades that part at the crotch, and the joint behind it.
cv::Mat HeldBlades() {
  cv::Mat mask(400, 640, CV_8UC1, cv::Scalar(0));
  for (const int side : {-1, 1}) {
    const std::vector<cv::Point> blade{{240, kRow},
                                       {kCrotchX, kRow},
                                       {560, kRow + side * 60},
                                       {300, kRow + side * 30},
                                       {240, kRow + side * 20}};
    cv::fillConvexPoly(mask, blade, 255);
  }
  return mask;
}

std::vector<WithoutHandles> CutIn(const cv::Mat& mask) {
  return CutOffHandles(FindSilhouettes(mask, 1).front(), {});
}

Vector2d CrotchOfBlades(const WithoutHandles& cut) {
  return Outline(cut.silhouette.contour).At(cut.crotches.blades);
}

Vector2d CrotchOfShanks(const WithoutHandles& cut) {
  return Outline(cut.silhouette.contour).At(cut.crotches.shanks);
}

TEST(CutOffHandles, CutsWhereTheJointRunsIntoAnotherThing) {
  cv::Mat mask = HeldBlades();
  cv::rectangle(mask, {20, 40}, {245, 360}, 255, cv::FILLED);
  const std::vector<WithoutHandles> cut = CutIn(mask);
  ASSERT_EQ(cut.size(), 1);
  EXPECT_LT((CrotchOfBlades(cut[0]) - Vector2d(kCrotchX, kRow)).norm(), 6);
  EXPECT_LT((CrotchOfShanks(cut[0]) - Vector2d(252, kRow)).norm(), 6);
  EXPECT_EQ(cut[0].silhouette.filled.at<uchar>(60, 100), 0) << "the other thing is left out";
  EXPECT_NE(cut[0].hidden.at<uchar>(60, 100), 0);
  EXPECT_EQ(cut[0].hidden.at<uchar>(kRow, kCrotchX), 0);
}

// A ruler under the handles that goes on beside the blades: their gap is no inlet of the hull.
TEST(CutOffHandles, FindsTheGapBesideAnotherThing) {
  cv::Mat mask = HeldBlades();
  const std::vector<cv::Point> ruler{
      {240, 300}, {20, 300}, {20, 20}, {600, 20}, {600, 110}, {240, 110}};
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{ruler}, 255);
  const std::vector<WithoutHandles> cut = CutIn(mask);
  EXPECT_TRUE(std::ranges::any_of(cut, [](const WithoutHandles& each) {
    return (CrotchOfBlades(each) - Vector2d(kCrotchX, kRow)).norm() < 6 &&
           (CrotchOfShanks(each) - Vector2d(248, kRow)).norm() < 8;
  }));
}

// Blades that open little cross far before their joint.
TEST(CutOffHandles, FindsTheJointFarBehindTheGap) {
  constexpr int kCrossingX = 480;
  cv::Mat mask = HeldBlades();
  cv::rectangle(mask, {20, 40}, {245, 360}, 255, cv::FILLED);
  const std::vector<cv::Point> crossed{
      {kCrotchX, kRow}, {kCrossingX, kRow - 43}, {kCrossingX, kRow + 43}};
  cv::fillConvexPoly(mask, crossed, 255);
  const std::vector<WithoutHandles> cut = CutIn(mask);
  ASSERT_EQ(cut.size(), 1);
  EXPECT_NEAR(CrotchOfBlades(cut[0]).x(), kCrossingX, 6);
  EXPECT_LT((CrotchOfShanks(cut[0]) - Vector2d(252, kRow)).norm(), 12);
}

TEST(CutOffHandles, CutsWhereTheFrameDoes) {
  const cv::Mat mask = HeldBlades();
  const std::vector<WithoutHandles> cut = CutIn(mask.colRange(250, mask.cols).clone());
  ASSERT_EQ(cut.size(), 1);
  EXPECT_NEAR(CrotchOfShanks(cut[0]).x(), 8, 5);
}

// Their own shape says where the shanks are, or that these are the arms of tweezers.
TEST(CutOffHandles, LeavesThingsThatEndBehindTheGap) { EXPECT_TRUE(CutIn(HeldBlades()).empty()); }

// As a cut by colour leaves them, which lost the slender shanks.
TEST(CutOffHandles, CutsRightBehindThePivotWhereThatIsKnown) {
  const Vector2d pivot(262, kRow);
  const std::vector<WithoutHandles> cut =
      CutOffHandles(FindSilhouettes(HeldBlades(), 1).front(), {}, pivot);
  ASSERT_EQ(cut.size(), 1);
  EXPECT_LT(CrotchOfShanks(cut[0]).x(), pivot.x());
}

TEST(CutOffHandles, LeavesShanksThatAreSeen) {
  cv::Mat mask = HeldBlades();
  for (const int side : {-1, 1})
    cv::line(mask, {242, kRow + side * 10}, {20, kRow + side * 120}, 255, 14);
  for (const WithoutHandles& cut : CutIn(mask))
    EXPECT_LT(CrotchOfBlades(cut).x(), 250) << "the blades have shanks";
}

}  // namespace
}  // namespace bladecurve
