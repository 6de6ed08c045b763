// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_parting.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "measured_blades.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/scissors/edge_difference.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Measured;
using testing::SceneWithMarkers;

// How a line leaves the edge towards the tip or the crotch: further and further, or as one that
// meets it again there.
enum class Course { kAway, kAndBack };

// Bends the edge away over a share of its length.
void LeadAstray(Measured* measured,
                LocatedBlade* blade,
                bool at_tip,
                Course course = Course::kAway,
                double share = 0.22,
                double most_px = 8) {
  constexpr double kBack = 0.1;
  std::vector<LocatedEdgePoint>& points = blade->edge.points;
  const auto count = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) / count;
    const double from_end = at_tip ? 1 - place : place;
    if (from_end > share) continue;
    const double back = std::clamp((from_end - kBack) / (share - kBack), 0.0, 1.0);
    const double away =
        course == Course::kAway ? 1 - from_end / share : std::sin(std::numbers::pi * back);
    const Vector2d shift = -most_px * away * points[i].normal;
    points[i].point_px += shift;
    points[i].trend_px += shift;
  }
  TrimToFree(measured->View(), blade);
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

void ExpectTheEndIsCut(bool upper, bool at_tip, Course course) {
  constexpr double kClosePx = 1.2;  // half the tolerance of the cut, and noise
  constexpr double kEndPx = 3;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& astray = measured.Blade(upper);
  const LocatedBlade& other = measured.Blade(!upper);
  const EdgeTruth& truth = measured.TrueEdge(upper);
  LeadAstray(&measured, &astray, at_tip, course);
  ASSERT_GT(FarthestFrom(truth, astray), 2 * kClosePx);
  const std::vector<Vector2d> others = PointsOf(other);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_LT(FarthestFrom(truth, astray), kClosePx) << upper << at_tip;
  EXPECT_LT((astray.end.point_px - truth.px.back()).norm(), kEndPx) << upper << at_tip;
  EXPECT_FALSE(measured.blades.edges_part);
  EXPECT_EQ(PointsOf(other), others) << upper << at_tip;
}

TEST(CutWhereEdgesPart, CutsTheEndThatLeavesItsCourse) {
  for (const bool upper : {true, false}) {
    for (const bool at_tip : {true, false}) ExpectTheEndIsCut(upper, at_tip, Course::kAway);
  }
}

TEST(CutWhereEdgesPart, CutsTheEndThatComesBackAtTheTip) {
  for (const bool upper : {true, false}) ExpectTheEndIsCut(upper, true, Course::kAndBack);
}

// As if only a scale had been given, and nothing of the view.
void ForgetView(Measured* measured) {
  measured->scale.sheet.reset();
  measured->scale.map = PlaneMap::Uniform(0.25, 0, "px");
}

TEST(CutWhereEdgesPart, CutsTheEndInAViewOfUnknownTiltWhereTheEdgesSeemAlike) {
  constexpr double kClosePx = 1.2;
  Measured measured{SceneWithMarkers()};
  LeadAstray(&measured, &measured.blades.upper, true);
  ForgetView(&measured);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_LT(FarthestFrom(measured.truth.upper, measured.blades.upper), kClosePx);
}

TEST(CutWhereEdgesPart, LeavesEdgesOfASlantedView) {
  Measured measured{SceneWithMarkers()};
  ForgetView(&measured);
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
  EXPECT_EQ(PointsOf(measured.blades.lower), lower);
}

TEST(CutWhereEdgesPart, LeavesEdgesThatMirrorEachOther) {
  Measured measured{SceneWithMarkers()};
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
  EXPECT_EQ(PointsOf(measured.blades.lower), lower);
}

// "Curved" scissors: both edges keep to their own course, one hollow, the other round.
TEST(CutWhereEdgesPart, LeavesBladesBentToOneSide) {
  for (const double curve_mm : {0.5, 1.0, -1.0}) {
    SceneSpec spec = SceneWithMarkers();
    spec.scissors.curve_mm = curve_mm;
    Measured measured{spec};
    const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
    const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
    CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
    EXPECT_EQ(PointsOf(measured.blades.upper), upper) << curve_mm;
    EXPECT_EQ(PointsOf(measured.blades.lower), lower) << curve_mm;
  }
}

// Two fifths of an edge are no end: nothing tells which of the two to believe.
TEST(CutWhereEdgesPart, LeavesEdgesThatPartOverMuchOfTheirLength) {
  constexpr double kShare = 0.4;
  Measured measured{SceneWithMarkers()};
  LeadAstray(&measured, &measured.blades.upper, true, Course::kAway, kShare);
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
  EXPECT_EQ(PointsOf(measured.blades.lower), lower);
  EXPECT_TRUE(measured.blades.edges_part);
}

// The other edge may be seen further into the crotch, which says nothing against the cut.
TEST(CutWhereEdgesPart, CutsAnEdgeThatBeginsLaterThanTheOther) {
  constexpr double kClosePx = 1.2, kUnseen = 0.18, kShare = 0.4;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& upper = measured.blades.upper;
  const auto unseen =
      static_cast<std::size_t>(kUnseen * static_cast<double>(upper.edge.points.size()));
  for (std::size_t i = 0; i < unseen; ++i) upper.edge.points[i].inlier = false;
  LeadAstray(&measured, &upper, false, Course::kAway, kShare);
  ASSERT_GT(FarthestFrom(measured.truth.upper, upper), 2 * kClosePx);
  CutWhereEdgesPart(measured.View(), measured.pivot, &measured.blades);
  EXPECT_LT(FarthestFrom(measured.truth.upper, upper), kClosePx);
  EXPECT_FALSE(measured.blades.edges_part);
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

void CompareEdges(Measured* measured) {
  measured->pivot.asymmetry = AsymmetryOf(
      measured->View(), measured->pivot, measured->blades.upper, measured->blades.lower);
}

TEST(CutUnlikeEnds, MakesEdgesAlikeOfWhichOneLeavesItsCourseAtTheCrotch) {
  constexpr double kClosePx = 1.2, kMostPx = 30, kShare = 0.25;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LeadAstray(&measured, &measured.Blade(upper), false, Course::kAway, kShare, kMostPx);
    CompareEdges(&measured);
    ASSERT_TRUE(AreUnlike(measured.pivot.asymmetry));
    CutUnlikeEnds(measured.View(), &measured.pivot, &measured.blades);
    EXPECT_TRUE(AreAlike(measured.pivot.asymmetry)) << upper;
    EXPECT_LT(FarthestFrom(measured.TrueEdge(upper), measured.Blade(upper)), kClosePx) << upper;
  }
}

// What is left of edges that differ from end to end is unlike still.
TEST(CutUnlikeEnds, LeavesEdgesOfWhichOneIsMisplaced) {
  constexpr double kAsidePx = 16;
  Measured measured{SceneWithMarkers()};
  LeadAstray(&measured, &measured.blades.upper, false);
  measured.Misplace(&measured.blades.lower, kAsidePx);
  CompareEdges(&measured);
  ASSERT_TRUE(AreUnlike(measured.pivot.asymmetry));
  const double asymmetry = measured.pivot.asymmetry;
  const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
  CutUnlikeEnds(measured.View(), &measured.pivot, &measured.blades);
  EXPECT_EQ(PointsOf(measured.blades.upper), upper);
  EXPECT_EQ(measured.pivot.asymmetry, asymmetry);
}

}  // namespace
}  // namespace bladecurve
