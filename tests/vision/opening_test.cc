// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/opening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vision/scissors/consistency.h"

namespace bladecurve {
namespace {

// An edge from (100, y) to (600, y), y down, that ends at its last point.
LocatedBlade StraightBlade(double y_px) {
  LocatedBlade blade;
  for (int x = 100; x <= 600; ++x) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = {x, y_px};
    point.normal = {0, y_px > 0 ? -1 : 1};
    point.sigma_px = 0.1;
    blade.used.push_back(point);
  }
  blade.edge.points = blade.used;
  blade.end.point_px = blade.used.back().point_px;
  blade.end.along_sigma_px = 0.5;
  return blade;
}

struct Spoilt {
  double asymmetry = 0;
  double common_sigma_px = 0;
};

Opening OpeningOf(const Spoilt& spoilt) {
  Pivot pivot;
  pivot.source = "screw";
  pivot.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  pivot.asymmetry = spoilt.asymmetry;
  Blades blades{StraightBlade(-60), StraightBlade(60)};
  for (LocatedBlade* blade : {&blades.upper, &blades.lower})
    blade->edge.common_sigma_px = spoilt.common_sigma_px;
  DoubtUnlikeEnds(pivot, &blades);
  return MeasureOpening(PlaneMap::Uniform(1, 0, "px"), pivot, blades.upper, blades.lower);
}

TEST(MeasureOpening, DoubtsTheAngleOfEdgesThatAreNoMirrorImages) {
  constexpr double kAsymmetry = 0.05;  // of the length: one edge may be turned by 0.05 rad
  const Opening alike = OpeningOf({0.005}), unlike = OpeningOf({-kAsymmetry});
  EXPECT_DOUBLE_EQ(alike.theta_rad, 2 * std::atan(0.1));
  EXPECT_DOUBLE_EQ(unlike.theta_rad, alike.theta_rad);
  EXPECT_LT(alike.sigma_rad, 0.001);
  EXPECT_GT(unlike.sigma_rad, 0.25 * kAsymmetry);
}

// Both edges lie that far out of their blades: the errors of the two ends add up.
TEST(MeasureOpening, IsAsUncertainAsTheOffsetThatBothEdgesShare) {
  constexpr double kOffsetPx = 2, kReachPx = 600;
  const Opening opening = OpeningOf({0, kOffsetPx});
  EXPECT_NEAR(opening.sigma_rad, 2 * kOffsetPx / kReachPx, 0.05 * 2 * kOffsetPx / kReachPx);
}

}  // namespace
}  // namespace bladecurve
