// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Points at an edge's ends that belong to another line, and where an edge runs at its end.
#include "vision/edge/edge_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

constexpr int kLength = 300;      // px, one point each
constexpr double kNoisePx = 0.1;  // of a point

// A cutting edge with a curve of its own; what leaves it is added to each point's offset. Points
// from `lost` on, `gap` of them, are missing.
std::vector<LocatedEdgePoint> Edge(int lost, int gap, const std::function<double(int)>& leaves_px) {
  testing::Gaussian noise(7);
  std::vector<LocatedEdgePoint> points;
  for (int i = 0; i < kLength; ++i) {
    const double t = static_cast<double>(i) / kLength;
    LocatedEdgePoint point;
    point.normal = {0, 1};
    point.point_px = {i, 20 * t * t - 8 * t * t * t + kNoisePx * noise() + leaves_px(i)};
    point.sigma_px = kNoisePx;
    point.inlier = i < lost || i >= lost + gap;
    points.push_back(point);
  }
  return points;
}

int InliersBetween(const std::vector<LocatedEdgePoint>& points, int first, int end) {
  return static_cast<int>(std::count_if(points.begin() + first,
                                        points.begin() + end,
                                        [](const LocatedEdgePoint& p) { return p.inlier; }));
}

constexpr int kGap = 20, kLost = 270, kBeyond = kLost + kGap;

TEST(RejectDetachedEnds, FewPointsThatLeaveTheCurveBeyondAGapAreStrays) {
  for (const double off_px : {-2.0, 2.0}) {
    auto points = Edge(kLost, kGap, [&](int i) { return i >= kBeyond ? off_px : 0; });
    EXPECT_TRUE(RejectDetachedEnds(points)) << off_px;
    EXPECT_EQ(InliersBetween(points, kBeyond, kLength), 0) << off_px;
    EXPECT_EQ(InliersBetween(points, 0, kLost), kLost) << off_px;
  }
}

TEST(RejectDetachedEnds, SoAreThoseBeforeAGapAtTheCrossing) {
  auto points = Edge(10, kGap, [](int i) { return i < 10 ? 2.0 : 0; });
  EXPECT_TRUE(RejectDetachedEnds(points));
  EXPECT_EQ(InliersBetween(points, 0, 10), 0);
  EXPECT_EQ(InliersBetween(points, 10 + kGap, kLength), kLength - 10 - kGap);
}

TEST(RejectDetachedEnds, PointsThatGoOnWithTheCurveStay) {
  auto points = Edge(kLost, kGap, [](int) { return 0.0; });
  EXPECT_FALSE(RejectDetachedEnds(points));
  EXPECT_EQ(InliersBetween(points, 0, kLength), kLength - kGap);
}

TEST(RejectDetachedEnds, ABendLongerThanTheGapIsTheEdgesOwn) {
  constexpr int kFrom = 240;
  auto points = Edge(kFrom, kGap, [](int i) { return i >= kFrom ? 0.1 * (i - kFrom) : 0; });
  EXPECT_FALSE(RejectDetachedEnds(points));
  EXPECT_EQ(InliersBetween(points, kFrom, kLength), kLength - kFrom - kGap);
}

TEST(RejectDetachedEnds, WithoutAGapNothingIsDetached) {
  auto points = Edge(kLength, 0, [](int i) { return i >= kBeyond ? 2.0 : 0; });
  EXPECT_FALSE(RejectDetachedEnds(points));
}

// Of the edge above, without the noise.
Eigen::Vector2d EndOnEdge() { return {kLength, 20.0 - 8.0}; }

constexpr CourseDoubt kAlone{1, 0};  // points independent, none bent by the tip

TEST(AbreastOnCourse, PutsAPlaceOffTheEdgeOntoIt) {
  constexpr double kClosePx = 0.1;
  const auto points = Edge(kLength, 0, [](int i) { return i % 12 == 0 ? 3.0 : 0; });
  for (const double off_px : {-2.0, 0.0, 2.0}) {
    const auto found = AbreastOnCourse(points, kAlone, EndOnEdge() + Eigen::Vector2d(0, off_px));
    ASSERT_TRUE(found) << off_px;
    EXPECT_LT((found->point_px - EndOnEdge()).norm(), kClosePx) << off_px;
  }
}

TEST(AbreastOnCourse, LeavesOutWhatLiesBeyond) {
  constexpr int kEnd = 250;
  constexpr double kClosePx = 0.1;
  const auto points =
      Edge(kLength, 0, [](int i) { return i > kEnd ? 0.02 * (i - kEnd) * (i - kEnd) : 0; });
  const double t = static_cast<double>(kEnd) / kLength;
  const Eigen::Vector2d end(kEnd, 20 * t * t - 8 * t * t * t);
  const auto found = AbreastOnCourse(points, kAlone, end + Eigen::Vector2d(0, 1));
  ASSERT_TRUE(found);
  EXPECT_LT((found->point_px - end).norm(), kClosePx);
}

// Of the cubic at its end, 4 / sqrt(points) sigmas; more where points go together, though less than
// by their number, as blades are known to bend little; and more beyond the last one.
TEST(AbreastOnCourse, SaysHowFarThePointsBearItOut) {
  const auto sigma = [](const std::vector<LocatedEdgePoint>& points, double correlation_px) {
    return AbreastOnCourse(points, {correlation_px, 0}, EndOnEdge()).value().across_sigma_px;
  };
  const auto straight = [](int) { return 0.0; };
  const auto points = Edge(kLength, 0, straight);
  const double alone = sigma(points, 1);
  EXPECT_NEAR(alone, kNoisePx * 4 / std::sqrt(0.6 * kLength), 0.2 * alone);
  EXPECT_GT(sigma(points, 16), 2 * alone);
  EXPECT_LT(sigma(points, 16), 4 * alone);
  EXPECT_GT(sigma(Edge(265, kLength - 265, straight), 1), 2 * alone);
}

// Points near the tip that leave the course of the others move the place, and it says so.
TEST(AbreastOnCourse, DoubtsPointsThatTheTipMayHaveBent) {
  constexpr double kSmearedPx = 30, kBentPx = 0.8;
  const auto bent = [](int i) { return i > kLength - kSmearedPx ? kBentPx : 0; };
  const auto found = AbreastOnCourse(Edge(kLength, 0, bent), {1, kSmearedPx}, EndOnEdge());
  ASSERT_TRUE(found);
  const double moved_px = (found->point_px - EndOnEdge()).norm();
  EXPECT_GT(moved_px, 0.3 * kBentPx);
  EXPECT_NEAR(found->across_sigma_px, moved_px, 0.3 * moved_px);
}

TEST(AbreastOnCourse, BridgesNoWideGap) {
  for (const double off_px : {2.0, 20.0}) {
    const Eigen::Vector2d place_px = EndOnEdge() + Eigen::Vector2d(0, off_px);
    const auto found =
        AbreastOnCourse(Edge(240, kLength - 240, [](int) { return 0.0; }), {16, 0}, place_px);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->point_px, place_px);
    EXPECT_GT(found->across_sigma_px, 0.5 * off_px);
    EXPECT_LT(found->across_sigma_px, 2 * off_px);
  }
  EXPECT_FALSE(AbreastOnCourse({}, kAlone, EndOnEdge()));
}

}  // namespace
}  // namespace bladecurve
