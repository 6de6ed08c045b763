// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/end_pair.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kBladePx = 300;  // px, pivot to tips
constexpr double kHalfTheta = 0.3;
constexpr double kExact = 1e-9;  // px: rounding

Pivot PivotSeen() {
  Pivot pivot;
  pivot.point_px = {400, 350};
  pivot.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  return pivot;
}

// A straight edge on a ray from the pivot, its end found `end_px` from there.
LocatedBlade BladeOnRay(bool on_left, double end_px, double sigma_px, bool arc_seen) {
  const double angle = (on_left ? -1 : 1) * kHalfTheta;
  const Vector2d along(std::cos(angle), std::sin(angle));
  LocatedBlade blade;
  blade.on_left = on_left;
  for (double at = 60; at < kBladePx; at += 1) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = PivotSeen().point_px + at * along;
    point.normal = {along.y(), -along.x()};
    blade.edge.points.push_back(point);
  }
  blade.used = blade.edge.points;
  blade.end.point_px = PivotSeen().point_px + end_px * along;
  blade.end.along_sigma_px = sigma_px;
  blade.end.arc_seen = blade.end.certain = arc_seen;
  blade.end.evidence = arc_seen ? 100 : 0;
  return blade;
}

double LengthOf(const LocatedBlade& blade) {
  return (blade.end.point_px - PivotSeen().point_px).norm();
}

ScaleResult WithMarkers() {
  ScaleResult scale;
  scale.map = PlaneMap::Uniform(0.1, 0, "marker");
  scale.sheet.emplace();
  return scale;
}

ScaleResult WithoutMarkers() {
  ScaleResult scale;
  scale.map = PlaneMap::Uniform(0.1, 0, "mm-per-px");
  return scale;
}

// Against the joint normal distribution of both lengths. The opening angle takes the sum of the
// ends' errors, so it is their sum's uncertainty that must be right.
TEST(AgreeOnEnds, WeighsTheTwoLengthsByTheirUncertainties) {
  constexpr double kClear = 1, kVague = 10, kMade = 0.005 * kBladePx;  // px
  Blades blades{BladeOnRay(true, kBladePx + 9, kVague, false),
                BladeOnRay(false, kBladePx, kClear, true)};
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  Eigen::Matrix2d precision;
  const double like = 1 / (kMade * kMade);
  precision << 1 / (kVague * kVague) + like, -like, -like, 1 / (kClear * kClear) + like;
  const Vector2d right((kBladePx + 9) / (kVague * kVague), kBladePx / (kClear * kClear));
  const Eigen::Matrix2d covariance = precision.inverse();
  const Vector2d expected = covariance * right;
  constexpr double kClose = 0.05;  // px; the pivot's own uncertainty
  EXPECT_NEAR(LengthOf(blades.upper), expected[0], kClose);
  EXPECT_NEAR(LengthOf(blades.lower), expected[1], kClose);
  const double sum = std::hypot(blades.upper.end.along_sigma_px, blades.lower.end.along_sigma_px);
  EXPECT_NEAR(sum, std::sqrt(covariance.sum()), kClose);
}

TEST(AgreeOnEnds, LeavesFreelyPhotographedBladesTheirLengths) {
  Blades blades{BladeOnRay(true, kBladePx, 1, true), BladeOnRay(false, 0.92 * kBladePx, 1, true)};
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
  EXPECT_EQ(blades.lower.end.along_sigma_px, 1);
  EXPECT_FALSE(blades.ends_contradict);
}

TEST(AgreeOnEnds, DoubtsTheEndOfABladeThatNoSlantMakesSoShort) {
  for (const bool arc_seen : {true, false}) {
    const double length = (arc_seen ? 0.85 : 0.92) * kBladePx;
    Blades blades{BladeOnRay(true, kBladePx, 1, true), BladeOnRay(false, length, 1, arc_seen)};
    AgreeOnEnds(WithoutMarkers(), PivotSeen(), &blades);
    EXPECT_NEAR(LengthOf(blades.lower), length, kExact);
    EXPECT_GE(blades.lower.end.along_sigma_px, 0.5 * (kBladePx - length));
    EXPECT_EQ(blades.upper.end.along_sigma_px, 1);
    EXPECT_TRUE(blades.ends_contradict);
  }
}

TEST(AgreeOnEnds, PutsTheEndWhereTheOtherBladesArcIsSeen) {
  for (const bool upper_seen : {false, true}) {
    Blades blades{BladeOnRay(true, upper_seen ? kBladePx : kBladePx - 40, 1, upper_seen),
                  BladeOnRay(false, upper_seen ? kBladePx - 40 : kBladePx, 1, !upper_seen)};
    AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
    EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact) << upper_seen;
    EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact) << upper_seen;
    const LocatedBlade& moved = upper_seen ? blades.lower : blades.upper;
    EXPECT_EQ(moved.end.index, moved.edge.points.size()) << "all points lie before the end";
    EXPECT_GT(moved.end.along_sigma_px, 3) << "it is not seen there";
  }
}

// An arc at the tip, and one beyond the other tip across which light steps the other way.
TEST(AgreeOnEnds, PutsTheEndWhereTheOtherBladesArcIsNoShadows) {
  constexpr double kShadow = 15;  // px
  Blades blades{BladeOnRay(true, kBladePx + kShadow, 1, true),
                BladeOnRay(false, kBladePx, 1, true)};
  blades.upper.end.evidence = 0;
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
  EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
  EXPECT_GT(blades.upper.end.along_sigma_px, 1) << "it is not seen there";
  EXPECT_TRUE(blades.ends_contradict);
}

// A tip that fades into its ground ends early; nothing makes one end late as clearly.
TEST(AgreeOnEnds, PutsTheEndOfAFadingTipWhereTheOtherOneEndsMoreClearly) {
  constexpr double kFaded = kBladePx - 35;  // px
  for (const double evidence : {100.0, 1000.0}) {
    Blades blades{BladeOnRay(true, kFaded, 1, true), BladeOnRay(false, kBladePx, 1, true)};
    blades.upper.end.evidence = 100;
    blades.lower.end.evidence = evidence;
    AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
    EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
    EXPECT_NEAR(LengthOf(blades.upper), evidence > 100 ? kBladePx : kFaded, kExact);
    EXPECT_TRUE(blades.ends_contradict);
  }
}

// The arc of a tip that is cut off square is not quite where the step along the edge ends.
TEST(AgreeOnEnds, PutsTheEndOfAFadingTipWhereTheOtherOneEndsNearAClearerArc) {
  constexpr double kFaded = kBladePx - 35;  // px
  for (const double evidence : {100.0, 1000.0}) {
    Blades blades{BladeOnRay(true, kFaded, 1, true), BladeOnRay(false, kBladePx, 7, false)};
    blades.lower.rival_ends = {BladeOnRay(false, kBladePx - 6, 1, true).end};
    blades.lower.rival_ends[0].evidence = evidence;
    AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
    const double length = evidence > 100 ? kBladePx : kFaded;
    EXPECT_NEAR(LengthOf(blades.lower), length, kExact) << evidence;
    EXPECT_NEAR(LengthOf(blades.upper), length, kExact) << evidence;
  }
}

TEST(AgreeOnEnds, TakesTheLongerOfTwoBladesThatBothFade) {
  Blades blades{BladeOnRay(true, kBladePx, 5, false), BladeOnRay(false, kBladePx - 25, 5, false)};
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
  EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
  EXPECT_GE(blades.lower.end.along_sigma_px, 5);
}

// Shadows of both tips, equally long, and the tips themselves.
TEST(AgreeOnEnds, TakesThePairThatIsSeenBest) {
  constexpr double kShadow = 28;  // px
  const auto with_rival = [&](bool on_left, double evidence, double rival_evidence) {
    LocatedBlade blade = BladeOnRay(on_left, kBladePx + kShadow, 1, true);
    blade.rival_ends = {BladeOnRay(on_left, kBladePx, 1, true).end};
    blade.end.evidence = evidence;
    blade.rival_ends[0].evidence = rival_evidence;
    return blade;
  };
  Blades clear{with_rival(true, 100, 300), with_rival(false, 100, 300)};
  AgreeOnEnds(WithMarkers(), PivotSeen(), &clear);
  EXPECT_NEAR(LengthOf(clear.upper), kBladePx, kExact);
  EXPECT_NEAR(LengthOf(clear.lower), kBladePx, kExact);
  Blades faint{with_rival(true, 300, 100), with_rival(false, 300, 100)};
  AgreeOnEnds(WithMarkers(), PivotSeen(), &faint);
  EXPECT_NEAR(LengthOf(faint.upper), kBladePx + kShadow, kExact);
  Blades free{with_rival(true, 100, 300), with_rival(false, 100, 300)};
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &free);
  EXPECT_NEAR(LengthOf(free.upper), kBladePx, kExact);
  EXPECT_NEAR(LengthOf(free.lower), kBladePx, kExact);
}

// Grain ends on arcs of few lines, on both blades at about the same length by chance; seen freely,
// blades may differ by much.
TEST(AgreeOnEnds, TakesNoPairOfUncertainArcsInAViewOfUnknownTilt) {
  const auto with_rival = [](bool on_left) {
    LocatedBlade blade = BladeOnRay(on_left, kBladePx, 5, false);
    blade.rival_ends = {BladeOnRay(on_left, kBladePx - (on_left ? 25 : 30), 1, true).end};
    blade.rival_ends[0].certain = false;
    return blade;
  };
  Blades blades{with_rival(true), with_rival(false)};
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
  EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
}

// A line on one blade ends like a tip, clearer than it; the other blade has its end elsewhere.
TEST(AgreeOnEnds, TakesNoRivalThatTheOtherBladeContradicts) {
  Blades blades{BladeOnRay(true, kBladePx, 1, true), BladeOnRay(false, kBladePx, 1, true)};
  blades.upper.rival_ends = {BladeOnRay(true, kBladePx - 60, 1, true).end};
  blades.upper.end.evidence = blades.lower.end.evidence = 100;
  blades.upper.rival_ends[0].evidence = 1000;
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
  EXPECT_FALSE(blades.ends_contradict);
}

// Nothing on the other blade confirms it.
TEST(AgreeOnEnds, TakesNoRivalBesideAnEndWithoutArc) {
  Blades blades{BladeOnRay(true, kBladePx, 20, false), BladeOnRay(false, kBladePx, 20, false)};
  blades.upper.rival_ends = {BladeOnRay(true, kBladePx - 25, 1, true).end};
  blades.upper.rival_ends[0].evidence = 100;
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx, kExact);
}

// The likely arc steps the other way than the edge does, as that of a shadow.
TEST(AgreeOnEnds, LeavesAShadowsArcAlsoBesideAnEndWithoutArc) {
  constexpr double kShadow = 28;  // px
  Blades blades{BladeOnRay(true, kBladePx, 20, false),
                BladeOnRay(false, kBladePx + kShadow, 1, true)};
  blades.lower.end.evidence = 0;
  blades.lower.rival_ends = {BladeOnRay(false, kBladePx, 1, true).end};
  blades.lower.rival_ends[0].evidence = 100;
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
}

// Where nothing else is seen the end stays there, less surely.
TEST(AgreeOnEnds, DoubtsAShadowsArc) {
  constexpr double kLeastDoubt = 0.015 * kBladePx;  // px
  Blades blades{BladeOnRay(true, kBladePx, 20, false), BladeOnRay(false, kBladePx, 1, true)};
  blades.lower.end.evidence = 0;
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &blades);
  EXPECT_NEAR(LengthOf(blades.lower), kBladePx, kExact);
  EXPECT_GT(blades.lower.end.along_sigma_px, kLeastDoubt);
}

// A shadow's arc may lie anywhere within a few hundredths of the length.
TEST(AgreeOnEnds, WeighsAShadowsArcThatTheOtherBladesEndContradicts) {
  constexpr double kBeyond = 24, kVague = 5;  // px
  Blades blades{BladeOnRay(true, kBladePx + kBeyond, 1, true),
                BladeOnRay(false, kBladePx, kVague, false)};
  blades.upper.end.evidence = 0;
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_TRUE(blades.ends_contradict);
  for (const LocatedBlade* blade : {&blades.upper, &blades.lower}) {
    EXPECT_GT(LengthOf(*blade), kBladePx);
    EXPECT_LT(LengthOf(*blade), kBladePx + 0.75 * kBeyond);
    EXPECT_GT(blade->end.along_sigma_px, 0.7 * kVague);
  }
}

TEST(AgreeOnEnds, SaysNothingAboutAPivotGivenBeyondTheTips) {
  Blades blades{BladeOnRay(true, kBladePx + 5, 10, false), BladeOnRay(false, kBladePx, 1, true)};
  Pivot beyond = PivotSeen();
  beyond.point_px.x() += 2 * kBladePx;
  AgreeOnEnds(WithMarkers(), beyond, &blades);
  EXPECT_NEAR(LengthOf(blades.upper), kBladePx + 5, kExact);
  EXPECT_EQ(blades.upper.end.along_sigma_px, 10);
}

TEST(AgreeOnEnds, DoubtsEndsThatContradictEachOther) {
  constexpr double kGap = 80;  // px
  const auto apart = [] {
    return Blades{BladeOnRay(true, kBladePx, 1, true), BladeOnRay(false, kBladePx - kGap, 1, true)};
  };
  Blades level = apart(), slanted = apart();
  AgreeOnEnds(WithMarkers(), PivotSeen(), &level);
  AgreeOnEnds(WithoutMarkers(), PivotSeen(), &slanted);
  EXPECT_TRUE(level.ends_contradict);
  EXPECT_TRUE(slanted.ends_contradict);
  EXPECT_NEAR(LengthOf(level.upper), kBladePx, kExact);
  EXPECT_GT(level.upper.end.along_sigma_px, 0.4 * kGap);
  EXPECT_GT(level.lower.end.along_sigma_px, 0.4 * kGap);
}

// Pivot at (400, 350), tips 287 px to its right.
TEST(RefuseCutOffBlade, WhereTheShorterOneWouldRunOutOfThePicture) {
  const cv::Size wide(800, 700), narrow(680, 700);
  for (const ScaleResult& scale : {WithMarkers(), WithoutMarkers()}) {
    for (const bool upper_short : {false, true}) {
      for (const bool seen : {false, true}) {
        Blades blades{BladeOnRay(true, upper_short ? 0.7 * kBladePx : kBladePx, 1, !upper_short),
                      BladeOnRay(false, upper_short ? kBladePx : 0.7 * kBladePx, 1, upper_short)};
        (upper_short ? blades.upper : blades.lower).end.arc_seen = seen;
        AgreeOnEnds(scale, PivotSeen(), &blades);
        ASSERT_TRUE(blades.ends_contradict);
        EXPECT_NO_THROW(RefuseCutOffBlade(scale, PivotSeen(), blades, wide));
        EXPECT_THROW(RefuseCutOffBlade(scale, PivotSeen(), blades, narrow), Refused);
      }
    }
  }
}

TEST(RefuseCutOffBlade, LeavesBladesOfOneLength) {
  const cv::Size narrow(680, 700);
  Blades blades{BladeOnRay(true, kBladePx, 1, true), BladeOnRay(false, 0.99 * kBladePx, 5, true)};
  AgreeOnEnds(WithMarkers(), PivotSeen(), &blades);
  EXPECT_NO_THROW(RefuseCutOffBlade(WithMarkers(), PivotSeen(), blades, narrow));
}

}  // namespace
}  // namespace bladecurve
