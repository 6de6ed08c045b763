// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/located_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A straight edge, a point a pixel, that passes the origin at `offset_px` and is inclined by
// `angle_rad` to the x axis.
LocatedBlade StraightBlade(double offset_px, double angle_rad, int from_px, int to_px) {
  const Vector2d along(std::cos(angle_rad), std::sin(angle_rad)), across(-along.y(), along.x());
  LocatedBlade blade;
  blade.edge.blur_px = 1;
  for (int i = from_px; i <= to_px; ++i) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = i * along + offset_px * across;
    point.normal = across;
    blade.used.push_back(point);
  }
  return blade;
}

// Two edges that cross at `crossing_px` on the x axis, and mirror each other about it.
Blades CrossingAt(double crossing_px, int from_px) {
  constexpr double kAngle = 0.2;
  const double offset_px = crossing_px * std::sin(kAngle);
  return {StraightBlade(-offset_px, kAngle, from_px, 300),
          StraightBlade(offset_px, -kAngle, from_px, 300)};
}

TEST(KeepBeyondCrossing, DropsWhereTheBladesCoverEachOther) {
  constexpr double kCrossing = 80;
  Blades blades = CrossingAt(kCrossing, 20);
  KeepBeyondCrossing(&blades);
  for (const LocatedBlade* blade : {&blades.upper, &blades.lower}) {
    const double first_px = blade->used.front().point_px.x();
    EXPECT_GT(first_px, kCrossing);       // of one blade, the other's light does not reach it
    EXPECT_LT(first_px, kCrossing + 10);  // and nothing more than that is lost
    EXPECT_GT(blade->used.back().point_px.x(), 280);
  }
  EXPECT_GT(blades.upper.used.front().point_px.y(), 0);
  EXPECT_LT(blades.lower.used.front().point_px.y(), 0);
}

TEST(KeepBeyondCrossing, LeavesEdgesThatCrossNowhere) {
  Blades blades = CrossingAt(80, 100);
  KeepBeyondCrossing(&blades);
  EXPECT_EQ(blades.upper.used.size(), 201U);
  EXPECT_EQ(blades.lower.used.size(), 201U);
}

// Edges that cross far out are astray themselves.
TEST(KeepBeyondCrossing, LeavesHalfOfAnEdge) {
  Blades blades = CrossingAt(200, 20);
  KeepBeyondCrossing(&blades);
  EXPECT_EQ(blades.upper.used.size(), 281U);
}

// Standard uncertainty of a mean of independent points.
double SigmaOfMean(const std::vector<LocatedEdgePoint>& points) {
  double variance = 0;
  for (const LocatedEdgePoint& point : points) variance += point.sigma_px * point.sigma_px;
  return std::sqrt(variance) / static_cast<double>(points.size());
}

TEST(DoubtedAlone, MakesTheLowerEdgeAsUncertainAsWhatTheEdgesDoNotShare) {
  constexpr double kShared = 2, kUpperAlone = 3, kLowerAlone = 4;  // px
  struct Case {
    double upper_alone, lower_alone, apart;
  };
  for (const auto& [upper_alone, lower_alone, apart] : {Case{0, 0, 0},
                                                        Case{kUpperAlone, 0, kUpperAlone},
                                                        Case{0, kLowerAlone, kLowerAlone},
                                                        Case{kUpperAlone, kLowerAlone, 5}}) {
    Blades blades = CrossingAt(80, 100);
    blades.upper.edge.alone_sigma_px = upper_alone;
    blades.lower.edge.alone_sigma_px = lower_alone;
    blades.upper.edge.common_sigma_px = std::hypot(kShared, upper_alone);
    blades.lower.edge.common_sigma_px = std::hypot(kShared, lower_alone);
    EXPECT_NEAR(SigmaOfMean(DoubtedAlone(blades.lower, blades.upper)), apart, 0.01 * apart);
  }
}

}  // namespace
}  // namespace bladecurve
