// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_parting.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Measured;
using testing::SceneWithMarkers;

// Bends the edge away over a share of its length, further and further towards the tip or the
// crotch, as a line does that meets it there.
void LeadAstray(Measured* measured, LocatedBlade* blade, bool at_tip) {
  constexpr double kShare = 0.22, kMostPx = -8;
  std::vector<LocatedEdgePoint>& points = blade->edge.points;
  const auto count = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) / count;
    const double from_end = at_tip ? 1 - place : place;
    if (from_end > kShare) continue;
    const Vector2d shift = kMostPx * (1 - from_end / kShare) * points[i].normal;
    points[i].point_px += shift;
    points[i].trend_px += shift;
  }
  TrimToFree(measured->photo, measured->scene, blade);
}

// Furthest that a point used lies from the true edge, px.
double FarthestFrom(const EdgeTruth& truth, const LocatedBlade& blade) {
  double farthest = 0;
  for (const LocatedEdgePoint& p : blade.used) {
    const auto nearest = std::min_element(
        truth.px.begin(), truth.px.end(), [&](const Vector2d& a, const Vector2d& b) {
          return (a - p.point_px).norm() < (b - p.point_px).norm();
        });
    farthest = std::max(farthest, std::abs(p.normal.dot(p.point_px - *nearest)));
  }
  return farthest;
}

TEST(CutWhereEdgesPart, CutsTheEndThatLeavesItsCourse) {
  constexpr double kClosePx = 1.2;  // half the tolerance of the cut, and noise
  constexpr double kEndPx = 3;
  for (const bool upper : {true, false}) {
    for (const bool at_tip : {true, false}) {
      Measured measured{SceneWithMarkers()};
      LocatedBlade& astray = upper ? measured.blades.upper : measured.blades.lower;
      const LocatedBlade& other = upper ? measured.blades.lower : measured.blades.upper;
      const EdgeTruth& truth = upper ? measured.truth.upper : measured.truth.lower;
      LeadAstray(&measured, &astray, at_tip);
      ASSERT_GT(FarthestFrom(truth, astray), 2 * kClosePx);
      const std::vector<Vector2d> others = PointsOf(other);
      CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
      EXPECT_LT(FarthestFrom(truth, astray), kClosePx) << upper << at_tip;
      EXPECT_LT((astray.end.point_px - truth.px.back()).norm(), kEndPx) << upper << at_tip;
      EXPECT_EQ(PointsOf(other), others) << upper << at_tip;
    }
  }
}

TEST(CutWhereEdgesPart, LeavesEdgesThatMirrorEachOther) {
  Measured measured{SceneWithMarkers()};
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
  EXPECT_EQ(PointsOf(measured.blades.lower), lower);
}

// One edge as a whole aside of its place: nobody knows which, let alone whose end is astray.
TEST(CutWhereEdgesPart, LeavesEdgesThatAreNoMirrorImages) {
  constexpr double kAsidePx = 16;
  Measured measured{SceneWithMarkers()};
  LeadAstray(&measured, &measured.blades.upper, true);
  measured.Misplace(&measured.blades.lower, kAsidePx);
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
}

}  // namespace
}  // namespace bladecurve
