// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/opening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

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
  pivot.point_px = {0, 0};
  pivot.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  pivot.asymmetry = spoilt.asymmetry;
  Blades blades{StraightBlade(-60), StraightBlade(60)};
  for (LocatedBlade* blade : {&blades.upper, &blades.lower})
    blade->edge.common_sigma_px = spoilt.common_sigma_px;
  DoubtUnlikeEnds(pivot, {}, &blades);
  return MeasureOpening(
      PlaneMap::Uniform(1, 0, "px"), std::nullopt, pivot, blades.upper, blades.lower);
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

// A point of the plane as a camera slanted by that angle about the vertical axis sees it.
Vector2d SeenAtSlant(const Camera& camera, double slant_rad, const Vector2d& from_middle) {
  const double f = camera.focal_length_px();
  const double depth = f + from_middle.x() * std::sin(slant_rad);
  return camera.k.topRightCorner<2, 1>() +
         f / depth * Vector2d(from_middle.x() * std::cos(slant_rad), from_middle.y());
}

// Of straight blades whose places in the plane are counted from the picture's middle.
Opening OpeningAtSlant(const Camera& camera, double slant_rad) {
  Blades blades{StraightBlade(-60), StraightBlade(60)};
  blades.upper.end.point_px = SeenAtSlant(camera, slant_rad, {0, -300});
  blades.lower.end.point_px = SeenAtSlant(camera, slant_rad, {0, 300});
  Pivot pivot;
  pivot.point_px = SeenAtSlant(camera, slant_rad, {-700, 0});
  return MeasureOpening(
      PlaneMap::Uniform(1, 0, "px"), CameraKnowledge{camera}, pivot, blades.upper, blades.lower);
}

// About the other axis a slant turns both blades alike.
TEST(MeasureOpening, KnowsWhatAnUnknownSlantDoesToTheAngle) {
  const Camera camera = CentredCamera(2000, 1600, 1200);
  const Opening from_above = OpeningAtSlant(camera, 0);
  const double moved = OpeningAtSlant(camera, kFreehandSlantRad).theta_rad - from_above.theta_rad;
  EXPECT_GT(std::abs(moved), 0.01);
  EXPECT_NEAR(from_above.view_sigma_rad, std::abs(moved), 0.1 * std::abs(moved));
}

// From afar nothing but foreshortening is seen of a slant. About one axis it opens the blades by
// c s^2, about the other it closes them: (c s^2 - c t^2) has a standard deviation of 2 c sigma^2.
TEST(MeasureOpening, KnowsWhatForeshorteningDoesToTheAngle) {
  const Camera camera = CentredCamera(2e6, 1600, 1200);
  const Opening from_above = OpeningAtSlant(camera, 0);
  const double moved = OpeningAtSlant(camera, kFreehandSlantRad).theta_rad - from_above.theta_rad;
  EXPECT_GT(std::abs(moved), 0.0005);
  EXPECT_NEAR(from_above.view_sigma_rad, 2 * std::abs(moved), 0.1 * std::abs(moved));
}

}  // namespace
}  // namespace bladecurve
