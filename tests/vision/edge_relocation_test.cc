// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_relocation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "measured_blades.h"
#include "tests/degree.h"
#include "vision/scissors/borrowed_edge.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

using testing::FarFrom;
using testing::Measured;
using testing::SceneWithMarkers;
using testing::SceneWithShadow;
using testing::WithoutColours;

void Relocate(Measured* measured) {
  RelocateUnlikeEdges(measured->View(), &measured->pivot, &measured->blades);
}

TEST(RelocateUnlikeEdges, FindsTheMisplacedEdgeOfEitherBlade) {
  constexpr double kAsidePx = 16, kClosePx = 0.3, kAlike = 0.01;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& misplaced = measured.Blade(upper);
    const EdgeTruth& truth = measured.TrueEdge(upper);
    measured.Misplace(&misplaced, kAsidePx);
    ASSERT_GT(FarFrom(truth, misplaced.used), 0.9 * kAsidePx);
    Relocate(&measured);
    EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.upper.used), kClosePx) << upper;
    EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.used), kClosePx) << upper;
    EXPECT_LT(std::abs(measured.pivot.asymmetry), kAlike) << upper;
  }
}

// The trace of the scene followed a shadow's border, or a bevel's: turned, and no mirror image.
TEST(RelocateUnlikeEdges, FindsAnEdgeThatWasNeverLocatedHoweverFarOffItsTrace) {
  constexpr double kOffPx = 25, kClosePx = 0.3;
  for (const bool known_view : {true, false}) {
    for (const bool traced : {true, false}) {
      Measured measured{SceneWithMarkers()};
      LocatedBlade& lower = measured.blades.lower;
      measured.MakeClear(&measured.blades.upper);
      measured.Lose(&lower, 0);
      measured.Shift(&lower, [&](double share) { return -kOffPx * share * share; });
      lower.edge.traced = traced;
      if (!known_view) measured.scale.sheet.reset();
      Relocate(&measured);
      const double off_px = FarFrom(measured.truth.lower, lower.used);
      if (traced) {
        EXPECT_LT(off_px, kClosePx) << known_view;
        EXPECT_FALSE(lower.edge.traced);
        EXPECT_GE(lower.edge.ambiguity, known_view ? 0 : 0.6);
      } else {
        EXPECT_GT(off_px, 2) << "something else finds it, " << known_view;
      }
    }
  }
}

// As if another line had been followed from so far along the edge on to so far.
void Bulge(Measured* measured, LocatedBlade* blade, double from, double to, double outwards_px) {
  measured->Shift(blade, [&](double share) {
    if (share < from || share > to) return 0.0;
    return outwards_px * std::sin(std::numbers::pi * (share - from) / (to - from));
  });
}

TEST(RelocateUnlikeEdges, FindsTheEdgeThatPassesThePivotAlikeButIsUnlikeInShape) {
  constexpr double kBulgePx = 16, kClosePx = 0.3;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& unlike = measured.Blade(upper);
    const EdgeTruth& truth = measured.TrueEdge(upper);
    Bulge(&measured, &unlike, 0.65, 1, kBulgePx);
    ASSERT_FALSE(AreSuspect(measured.pivot.asymmetry)) << upper;
    Relocate(&measured);
    EXPECT_LT(FarFrom(truth, unlike.used), kClosePx) << upper;
    EXPECT_EQ(measured.Blade(!upper).moved, "");
  }
}

// Neither edge is what the other one's mirror image is.
TEST(RelocateUnlikeEdges, DoubtsTheVaguerOfEdgesOfUnlikeShapeByAsMuchAsTheyDiffer) {
  constexpr double kBulgePx = 16, kVaguePx = 0.4;
  Measured measured{SceneWithMarkers()};
  measured.MakeClear(&measured.blades.upper);
  measured.MakeClear(&measured.blades.lower);
  measured.blades.lower.edge.common_sigma_px = kVaguePx;
  Bulge(&measured, &measured.blades.upper, 0.65, 1, kBulgePx);
  Bulge(&measured, &measured.blades.lower, 0.65, 1, -kBulgePx);
  ASSERT_FALSE(AreSuspect(measured.pivot.asymmetry));
  Relocate(&measured);
  EXPECT_GT(measured.blades.lower.edge.ambiguity, 0.7);
  EXPECT_GT(measured.blades.lower.edge.common_sigma_px, kBulgePx / 2);
  EXPECT_LT(measured.blades.upper.edge.ambiguity, 0.5);
}

// Deeper within the blade than any shadow is wide there may be a line, but it is not the edge.
TEST(RelocateUnlikeEdges, TakesNoEdgeToBeyondTheMiddleOfItsBlade) {
  constexpr double kAsidePx = 16, kClosePx = 0.3;
  for (const double share_of_width : {0.3, 0.6}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& lower = measured.blades.lower;
    measured.Misplace(&lower, kAsidePx);
    measured.MakeClear(&measured.blades.upper);
    lower.edge.common_sigma_px = 0.5;
    SceneBlade& seen = measured.scene.right;
    seen.inner_px = PointsOf(lower);
    seen.width_px = kAsidePx / share_of_width;
    Relocate(&measured);
    const double off_px = FarFrom(measured.truth.lower, lower.used);
    if (share_of_width < 0.5) {
      EXPECT_LT(off_px, kClosePx);
    } else {
      EXPECT_GT(off_px, 0.9 * kAsidePx);
      EXPECT_GT(lower.edge.ambiguity, 0.7);
      EXPECT_GT(lower.edge.common_sigma_px, kAsidePx / 2);
    }
  }
}

// About a pivot so far forward that the edges hardly pass by it, the misplaced one stays.
TEST(RelocateUnlikeEdges, TakesNoEdgeToWhereItWouldHardlyPassByThePivot) {
  constexpr double kAsidePx = 16, kHardly = 0.04;
  Measured measured{SceneWithMarkers()};
  const auto compare = [&] {
    CompareEdges(measured.scale,
                 measured.scene,
                 PairOf(measured.blades.upper, measured.blades.lower),
                 &measured.pivot);
  };
  for (compare(); measured.pivot.overlap > kHardly; compare())
    measured.pivot.point_px += measured.truth.axis_px;
  measured.Misplace(&measured.blades.upper, kAsidePx);
  compare();
  ASSERT_TRUE(PassByPivot(measured.pivot));
  Relocate(&measured);
  EXPECT_EQ(measured.blades.upper.moved, "");
  EXPECT_TRUE(PassByPivot(measured.pivot));
}

// A bevel's inner border may stand out more than the cutting edge itself.
TEST(RelocateUnlikeEdges, FindsTheEdgeOutsideOfAClearerLineOnTheBlade) {
  constexpr double kInsidePx = 16, kClosePx = 0.3;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& misplaced = measured.Blade(upper);
    const EdgeTruth& truth = measured.TrueEdge(upper);
    measured.Misplace(&misplaced, -kInsidePx, Measured::kStrong);
    ASSERT_GT(FarFrom(truth, misplaced.used), 0.9 * kInsidePx);
    Relocate(&measured);
    EXPECT_LT(FarFrom(truth, misplaced.used), kClosePx) << upper;
  }
}

// As sharp as print, a shadow's border looks like the blade's.
TEST(RelocateUnlikeEdges, FindsTheEdgeInsideOfAHardShadow) {
  constexpr double kShadowPx = 1.5, kClosePx = 0.3, kHardMm = 0.2;
  for (const double direction_rad : {225 * kDegree, 270 * kDegree, 315 * kDegree}) {
    const SceneSpec spec = SceneWithShadow(62 * kDegree, direction_rad, kHardMm);
    Measured measured{spec, WithoutColours(spec)};
    const EdgeTruth& truth = measured.truth.lower;
    ASSERT_GT(FarFrom(truth, measured.blades.lower.used), kShadowPx) << direction_rad;
    Relocate(&measured);
    EXPECT_LT(FarFrom(truth, measured.blades.lower.used), kClosePx) << direction_rad;
    EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.upper.used), kClosePx) << direction_rad;
  }
}

// Black blades are darker than their shadows.
TEST(RelocateUnlikeEdges, FindsTheEdgeOfABlackBladeInsideOfAHardShadow) {
  constexpr double kShadowPx = 1.5, kClosePx = 0.3, kHardMm = 0.2;
  for (const double direction_rad : {225 * kDegree, 270 * kDegree}) {
    SceneSpec spec = SceneWithShadow(62 * kDegree, direction_rad, kHardMm);
    spec.finish = Finish::kBlack;
    Measured measured{spec, WithoutColours(spec)};
    const EdgeTruth& truth = measured.truth.lower;
    EXPECT_GT(FarFrom(truth, measured.blades.lower.used), kShadowPx) << direction_rad;
    Relocate(&measured);
    EXPECT_LT(FarFrom(truth, measured.blades.lower.used), kClosePx) << direction_rad;
    EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.upper.used), kClosePx) << direction_rad;
  }
}

// Edges that differ although nothing else is seen: one of them may be a bevel's or a shadow's line,
// unless the pivot is known no better than to lie aside.
TEST(RelocateUnlikeEdges, DoubtsTheVaguerOfEdgesThatNothingMakesAlike) {
  constexpr double kAsidePx = 2;
  for (const double pivot_sigma_px : {0.2, 1.0}) {
    Measured measured{SceneWithMarkers()};
    const Vector2d& axis = measured.truth.axis_px;
    measured.pivot.point_px += kAsidePx * Vector2d(-axis.y(), axis.x());
    measured.pivot.covariance_px2 *= pivot_sigma_px * pivot_sigma_px;
    measured.Compare();
    measured.MakeClear(&measured.blades.upper);
    measured.blades.lower.edge.common_sigma_px = 0.5;
    Relocate(&measured);
    EXPECT_EQ(measured.blades.lower.moved, "");
    EXPECT_LT(measured.blades.upper.edge.ambiguity, 0.5);
    const LocatedEdge& lower = measured.blades.lower.edge;
    const bool doubted = lower.ambiguity > 0.7 && lower.common_sigma_px > kAsidePx;
    EXPECT_EQ(doubted, pivot_sigma_px < 1) << pivot_sigma_px;
  }
}

// A pivot that is half a pixel aside leaves edges unlike that are right: a doubtful one is taken to
// there all the same.
TEST(RelocateUnlikeEdges, LeavesAShadowsBorderTheSoonerTheMoreDoubtfulItIs) {
  constexpr double kAsidePx = 0.6, kClosePx = 0.3, kHardMm = 0.2;
  for (const bool doubtful : {false, true}) {
    const SceneSpec spec = SceneWithShadow(72 * kDegree, 270 * kDegree, kHardMm);
    Measured measured{spec, WithoutColours(spec)};
    const Vector2d& axis = measured.truth.axis_px;
    measured.pivot.point_px += kAsidePx * Vector2d(-axis.y(), axis.x());
    measured.blades.lower.edge.ambiguity = doubtful ? 0.8 : 0.1;
    measured.Compare();
    Relocate(&measured);
    EXPECT_EQ(measured.blades.lower.moved.empty(), !doubtful);
    if (doubtful) {
      EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.used), kClosePx);
    }
  }
}

// Too little aside to be told by the mirror alone, 0.018 of the blades' length.
constexpr double kLittlePx = 3;

// As if the edge had been taken for the border of a hard shadow, with the edge as its rival.
void TakeShadowsBorder(Measured* measured, LocatedBlade* blade, double width_px, double rival) {
  std::vector<Vector2d> within;
  for (const LocatedEdgePoint& p : blade->edge.points) within.push_back(p.trend_px);
  measured->Misplace(blade, width_px, Measured::kStrong);
  blade->edge.rival_path_px = within;
  blade->edge.rival_px = -width_px;
  blade->edge.ambiguity = rival;
}

// Dark metal hardly parts from its shadow: the edge is a faint rival of the shadow's border.
TEST(RelocateUnlikeEdges, FindsBothEdgesInsideOfHardShadows) {
  constexpr double kWidePx = 16, kNarrowPx = 8, kClosePx = 0.3;
  const auto relocated = [&](double faint_rival) {
    Measured measured{SceneWithMarkers()};
    TakeShadowsBorder(&measured, &measured.blades.upper, kWidePx, faint_rival);
    TakeShadowsBorder(&measured, &measured.blades.lower, kNarrowPx, 0.9);
    Relocate(&measured);
    return measured;
  };
  const Measured measured = relocated(0.35);
  EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.upper.used), kClosePx);
  EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.used), kClosePx);
  const Measured without_rival = relocated(0.1);
  EXPECT_GT(FarFrom(without_rival.truth.lower, without_rival.blades.lower.used), kNarrowPx / 2);
}

TEST(RelocateUnlikeEdges, FindsTheDoubtfulEdgeThatIsLittleAside) {
  constexpr double kClosePx = 0.3;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& lost = measured.Blade(upper);
    const EdgeTruth& truth = measured.TrueEdge(upper);
    measured.MakeClear(&measured.Blade(!upper));
    measured.Lose(&lost, kLittlePx);
    ASSERT_GT(FarFrom(truth, lost.used), 0.7 * kLittlePx);
    Relocate(&measured);
    EXPECT_LT(FarFrom(truth, lost.used), kClosePx) << upper;
    EXPECT_LT(lost.edge.common_sigma_px, kLittlePx) << upper;
  }
}

// As where the edge of a dark bevel is lost beside a dark shadow of which the border stands out.
TEST(RelocateUnlikeEdges, FindsTheDoubtfulEdgeBesideAHigherStep) {
  constexpr double kAsidePx = 5, kClosePx = 0.3;
  for (const bool doubtful : {false, true}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& upper = measured.blades.upper;
    measured.MakeClear(&measured.blades.lower);
    measured.Misplace(&upper, kAsidePx, Measured::kStrong);
    measured.MakeClear(&upper);
    if (doubtful) upper.edge.ambiguity = 0.9;
    if (doubtful) upper.edge.common_sigma_px = kAsidePx;
    ASSERT_TRUE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    EXPECT_EQ(FarFrom(measured.truth.upper, upper.used) < kClosePx, doubtful);
  }
}

// The edges still differ, more than the pivot accounts for and towards the doubtful one's rival: it
// may lie between the two lines.
TEST(RelocateUnlikeEdges, IsAsUnsureOfTheDoubtfulEdgeAsTheEdgesStillDiffer) {
  constexpr double kAsidePx = 0.8, kSurePx = 0.1, kWithinPx = -6, kBeyondPx = 6;
  const auto sigma_px = [&](double pivot_sigma_px, double rival_px) {
    Measured measured{SceneWithMarkers()};
    measured.MakeClear(&measured.blades.lower);
    measured.Lose(&measured.blades.upper, kLittlePx);
    measured.blades.upper.edge.rival_px = rival_px;
    const Vector2d& axis = measured.truth.axis_px;
    measured.pivot.point_px += kAsidePx * Vector2d(-axis.y(), axis.x());
    measured.pivot.covariance_px2 *= pivot_sigma_px * pivot_sigma_px;
    measured.Compare();
    Relocate(&measured);
    EXPECT_NE(measured.blades.upper.moved, "");
    return measured.blades.upper.edge.common_sigma_px;
  };
  EXPECT_GT(sigma_px(kSurePx, kWithinPx), kAsidePx);
  EXPECT_LT(sigma_px(kSurePx, kBeyondPx), kAsidePx / 2);
  EXPECT_LT(sigma_px(kAsidePx, kWithinPx), kAsidePx / 2);
}

// What is just vague may be a faint border; the clearer line beside it may be a bevel's.
TEST(RelocateUnlikeEdges, LeavesAVagueEdgeThatHasNoRival) {
  constexpr double kAsidePx = 1, kVaguePx = 1.2;
  const auto moved = [&](double ambiguity) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& vague = measured.blades.upper;
    measured.MakeClear(&measured.blades.lower);
    measured.Lose(&vague, kAsidePx);
    vague.edge.ambiguity = ambiguity;
    vague.edge.common_sigma_px = kVaguePx;
    Relocate(&measured);
    return vague.moved;
  };
  EXPECT_EQ(moved(0.2), "");
  EXPECT_NE(moved(0.9), "");
}

TEST(RelocateUnlikeEdges, TakesNoDoubtfulEdgeForAMirror) {
  Measured measured{SceneWithMarkers()};
  measured.Lose(&measured.blades.upper, kLittlePx);
  measured.Lose(&measured.blades.lower, kLittlePx);
  const std::vector<Vector2d> before = PointsOf(measured.blades.lower);
  Relocate(&measured);
  EXPECT_EQ(PointsOf(measured.blades.lower), before);
}

TEST(RelocateUnlikeEdges, LeavesEdgesThatMirrorEachOther) {
  Measured measured{SceneWithMarkers()};
  for (LocatedBlade* blade : {&measured.blades.upper, &measured.blades.lower})
    measured.MakeClear(blade);
  const std::vector<Vector2d> before = PointsOf(measured.blades.upper);
  Relocate(&measured);
  EXPECT_EQ(PointsOf(measured.blades.upper), before);
}

// That a place where light falls makes the edges alike is no chance even in a view of unknown tilt,
// but it is said.
TEST(RelocateUnlikeEdges, FindsTheEdgeInsideOfAShadowWithoutMarkers) {
  constexpr double kShadowPx = 3, kClosePx = 0.3, kHardMm = 0.2, kWarned = 0.5;
  const SceneSpec spec = SceneWithShadow(54 * kDegree, 270 * kDegree, kHardMm);
  Measured measured{spec, WithoutColours(spec)};
  measured.scale.sheet.reset();
  ASSERT_GT(FarFrom(measured.truth.lower, measured.blades.lower.used), kShadowPx);
  Relocate(&measured);
  EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.used), kClosePx);
  EXPECT_NE(measured.blades.lower.moved, "");
  EXPECT_EQ(measured.blades.upper.moved, "");
  EXPECT_GT(measured.blades.lower.edge.ambiguity, kWarned);
}

// The dark line within a blade that is brighter than the ground is where its bevel begins.
TEST(RelocateUnlikeEdges, TakesNothingThatIsBrighterThanTheGroundForItsShadow) {
  constexpr double kHardMm = 0.2;
  Measured measured{SceneWithShadow(54 * kDegree, 270 * kDegree, kHardMm)};
  measured.scale.sheet.reset();
  for (LocatedEdgePoint& point : measured.blades.lower.edge.points)
    point.contrast = -std::abs(point.contrast);
  Relocate(&measured);
  EXPECT_EQ(measured.blades.lower.moved, "");
}

constexpr int kAboutCrotchPx = 40;

// Where the blades cross, as the scene without a bevel shows it.
void RestoreCrotch(const Measured& measured,
                   const SceneSpec& spec,
                   cv::Mat* picture,
                   int about_px = kAboutCrotchPx) {
  const Vector2d crotch = measured.blades.lower.used.front().trend_px;
  const cv::Rect about(static_cast<int>(crotch.x()) - about_px,
                       static_cast<int>(crotch.y()) - about_px,
                       2 * about_px,
                       2 * about_px);
  RenderScene(spec).bgr(about).copyTo((*picture)(about));
}

// Beside the blade at the truth's upper edge, which is measured as the lower one: over the other
// blade, or, which hides no edge, beneath it.
enum class Bevelled { kOver, kBeneath };
Measured WithMirroringBevelBelow(Bevelled blade) {
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.upper_on_top = blade == Bevelled::kOver;
  Measured measured{spec};
  cv::Mat picture = spec.scissors.upper_on_top ? testing::WithBrightBevel(spec)
                                               : testing::WithMirroringBevel(spec);
  if (!spec.scissors.upper_on_top) RestoreCrotch(measured, spec, &picture);
  measured.Misplace(&measured.blades.upper, -testing::kBevelPx);
  measured.photo = Measured::PhotoOf(picture);
  measured.scale.sheet.reset();
  measured.TurnOver();
  return measured;
}

TEST(RelocateUnlikeEdges, FindsTheEdgeBeyondABevelThatMirrorsTheGroundWithoutMarkers) {
  constexpr double kClosePx = 0.5, kWarned = 0.5;
  Measured measured = WithMirroringBevelBelow(Bevelled::kOver);
  Relocate(&measured);
  EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.lower.used), kClosePx);
  EXPECT_GT(measured.blades.lower.edge.ambiguity, kWarned);
}

// A blade beneath the other one, with a bevel so much darker than the ground of which the line on
// the blade was taken for the edge; measured as the lower one.
Measured WithDarkBevelBelow(double darker,
                            SceneSpec spec = SceneWithMarkers(),
                            int about_crotch_px = kAboutCrotchPx) {
  spec.scissors.upper_on_top = false;
  Measured measured{spec};
  cv::Mat picture = testing::Grained(testing::BrightenedAlongUpperEdge(
      spec, 0, testing::kBevelPx, [&](double, double) { return -darker; }));
  RestoreCrotch(measured, spec, &picture, about_crotch_px);
  measured.Misplace(&measured.blades.upper, -testing::kBevelPx, -Measured::kStrong);
  Measured::MakeClear(&measured.blades.upper);
  measured.photo = Measured::PhotoOf(picture);
  measured.scale.sheet.reset();
  measured.TurnOver();
  return measured;
}

// As if another line had been seen so far further out.
void AddRival(LocatedEdge* edge, double outwards_px) {
  edge->rival_px = outwards_px;
  edge->rival_path_px.clear();
  for (const LocatedEdgePoint& p : edge->points)
    edge->rival_path_px.push_back(p.trend_px + outwards_px * p.normal);
}

TEST(RelocateUnlikeEdges, FindsTheEdgeAlongAFaintLineFurtherOutWithoutMarkers) {
  constexpr double kDarker = 12, kClosePx = 0.5, kWarned = 0.5;
  for (const double rival_px : {0.0, testing::kBevelPx - 1.5, -testing::kBevelPx}) {
    Measured measured = WithDarkBevelBelow(kDarker);
    LocatedBlade& lower = measured.blades.lower;
    if (rival_px != 0) AddRival(&lower.edge, rival_px);
    Relocate(&measured);
    EXPECT_EQ(lower.moved.empty(), rival_px <= 0) << lower.moved;
    if (rival_px <= 0) continue;
    EXPECT_LT(FarFrom(measured.truth.upper, lower.used), kClosePx);
    EXPECT_GT(lower.edge.ambiguity, kWarned);
  }
}

// What lies beyond it is ground, not a bevel.
TEST(RelocateUnlikeEdges, LeavesNoEdgeAtWhichTheGroundsColourEnds) {
  constexpr double kDarker = 12;
  constexpr int kNearCrotchPx = 20;  // where the colour ends further out
  for (const Eigen::Vector3d& rgb : {Eigen::Vector3d(0.25, 0.25, 0.25), {0.1, 0.3, 0.2}}) {
    SceneSpec spec = SceneWithMarkers();
    spec.backdrop = Backdrop::kDrape;
    spec.drape_rgb = rgb;
    Measured measured = WithDarkBevelBelow(kDarker, spec, kNearCrotchPx);
    LocatedBlade& lower = measured.blades.lower;
    AddRival(&lower.edge, testing::kBevelPx - 1.5);
    Relocate(&measured);
    const bool coloured = rgb[0] != rgb[1];
    EXPECT_EQ(lower.moved.empty(), coloured) << lower.moved;
  }
}

// A line on the blade, however clear, is left for the edge further out, but not where that is
// unlike the other one in shape, or hardly more like it than the line is, or passes by the pivot
// unlike.
TEST(RelocateUnlikeEdges, LeavesAClearLineForTheEdgeThatMirrorsTheOtherOneWithoutMarkers) {
  constexpr double kClosePx = 0.2, kWarned = 0.5, kPivotSigmaPx = 0.3;
  struct Other {
    double bulges_px = 0, from = 0.3;
    double pivot_off_px = 0;
  };
  const auto is_left = [&](double inside_px, const Other& other) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& lower = measured.blades.lower;
    const Vector2d& axis = measured.truth.axis_px;
    measured.pivot.covariance_px2 *= kPivotSigmaPx * kPivotSigmaPx;
    measured.pivot.point_px += other.pivot_off_px * Vector2d(-axis.y(), axis.x());
    measured.Misplace(&lower, -inside_px, Measured::kStrong);
    Bulge(&measured, &measured.blades.upper, other.from, 1, other.bulges_px);
    for (LocatedBlade* blade : {&measured.blades.upper, &lower}) Measured::MakeClear(blade);
    measured.scale.sheet.reset();
    EXPECT_TRUE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    const bool is_found = FarFrom(measured.truth.lower, lower.used) < kClosePx;
    EXPECT_EQ(is_found, !lower.moved.empty());
    EXPECT_TRUE(!is_found || lower.edge.ambiguity > kWarned);
    return is_found;
  };
  EXPECT_TRUE(is_left(3, {}));
  EXPECT_TRUE(is_left(8, {}));
  EXPECT_FALSE(is_left(16, {})) << "no bevel is as wide";
  EXPECT_FALSE(is_left(8, {.bulges_px = 2.7}));
  EXPECT_FALSE(is_left(2, {.bulges_px = -2}));
  EXPECT_FALSE(is_left(10, {.bulges_px = 3, .from = 0, .pivot_off_px = 2}));
}

// The line on the blade stands out more; of a dim bevel it hides the edge, unless that is looked
// for not as far as to the line, and no pivot may have parted them. What is seen there is where it
// had to be: it may lie further off.
TEST(RelocateUnlikeEdges, FindsTheEdgeOfABevelWhoseLineStandsOutMoreWithoutMarkers) {
  constexpr double kClosePx = 0.6, kWarned = 0.5, kUnsure = 0.2, kPivotSigmaPx = 20;
  for (const double darker : {16.0, 40.0}) {
    const bool is_dim = darker < 20;
    for (const bool knows_pivot : {true, false}) {
      Measured measured = WithDarkBevelBelow(darker);
      const LocatedBlade& lower = measured.blades.lower;
      if (!knows_pivot) measured.pivot.covariance_px2 *= kPivotSigmaPx * kPivotSigmaPx;
      Relocate(&measured);
      EXPECT_EQ(lower.moved.empty(), is_dim && !knows_pivot);
      if (lower.moved.empty()) continue;
      EXPECT_LT(FarFrom(measured.truth.upper, lower.used), kClosePx) << darker;
      EXPECT_GT(lower.edge.ambiguity, kWarned) << darker;
      EXPECT_EQ(TotalSigma(lower.edge) > kUnsure * testing::kBevelPx, is_dim) << darker;
    }
  }
}

std::vector<LocatedEdgePoint> DistalThird(const LocatedBlade& blade) {
  return {blade.used.end() - static_cast<std::ptrdiff_t>(blade.used.size() / 3), blade.used.end()};
}

// As the edge of a bevel that fades into a shadow towards the tip.
TEST(BorrowDoubtfulOne, GoesOnAsTheClearEdgeDoesWhereTheOtherOneStraysIntoTheBlade) {
  constexpr double kClosePx = 0.3, kDoubt = 0.9, kFaint = 0.4;
  struct Stray {
    double from = 0.6, outwards_px = -10;
  };
  const auto borrowed = [&](bool upper, double doubt, double doubt_of_other, const Stray& strays) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade &stray = measured.Blade(upper), &other = measured.Blade(!upper);
    Measured::MakeClear(&other);
    other.edge.ambiguity = doubt_of_other;
    Bulge(&measured, &stray, strays.from, 1, strays.outwards_px);
    stray.edge.ambiguity = doubt;
    stray.edge.common_sigma_px = 0.1;
    const bool moved = BorrowDoubtfulOne(measured.View(), measured.pivot, &measured.blades);
    EXPECT_EQ(moved, FarFrom(measured.TrueEdge(upper), DistalThird(stray)) < kClosePx);
    EXPECT_EQ(moved, !stray.moved.empty());
    return moved;
  };
  for (const bool upper : {true, false}) {
    EXPECT_TRUE(borrowed(upper, kDoubt, 0, {})) << upper;
    EXPECT_TRUE(borrowed(upper, 0, 0, {})) << upper << ": clear, it leaves a blade's course";
    EXPECT_FALSE(borrowed(upper, kDoubt, kDoubt, {})) << upper << ": both may have strayed";
    EXPECT_FALSE(borrowed(upper, kDoubt, kFaint, {})) << upper << ": the other one may be wrong";
    EXPECT_FALSE(borrowed(upper, kDoubt, 0, {0, -10})) << upper << ": it strays along most of it";
    EXPECT_FALSE(borrowed(upper, kDoubt, 0, {0.6, 10})) << upper << ": the rest may have strayed";
  }
}

TEST(BorrowDoubtfulOne, IsNotMisledByAPivotThatLiesAside) {
  constexpr double kAsidePx = 1, kClosePx = 0.3;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& lower = measured.blades.lower;
  Measured::MakeClear(&measured.blades.upper);
  Bulge(&measured, &lower, 0.6, 1, -10);
  lower.edge.ambiguity = 0.9;
  lower.edge.common_sigma_px = 0.1;
  measured.pivot.point_px.y() += kAsidePx;  // the tips lie right
  ASSERT_TRUE(BorrowDoubtfulOne(measured.View(), measured.pivot, &measured.blades));
  EXPECT_LT(FarFrom(measured.truth.lower, DistalThird(lower)), kClosePx);
}

// What is seen where the other one puts it is no surer than what was.
TEST(RelocateUnlikeEdges, BorrowsADoubtfulEdgeOfWhichAnEndStrays) {
  constexpr double kStraysPx = 4, kFrom = 0.73;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& lower = measured.blades.lower;
  Measured::MakeClear(&measured.blades.upper);
  measured.Shift(&lower, [&](double share) { return share < kFrom ? 0 : -kStraysPx; });
  lower.edge.ambiguity = 0.9;
  lower.edge.common_sigma_px = 0;
  ASSERT_FALSE(AreSuspect(measured.pivot.asymmetry));
  Relocate(&measured);
  EXPECT_EQ(lower.moved, "the other one mirrored, on which most of it lies");
}

TEST(BorrowInnerOne, TakesNoDoubtfulEdgeForAMirror) {
  for (const bool doubtful : {false, true}) {
    Measured measured = WithMirroringBevelBelow(Bevelled::kOver);
    if (doubtful) measured.blades.upper.edge.ambiguity = 1;
    const MirrorLine line = LineBetween(measured.View(), measured.pivot, measured.blades);
    BorrowInnerOne(measured.View(), line, measured.pivot, &measured.blades);
    EXPECT_EQ(measured.blades.lower.moved.empty(), doubtful);
  }
}

// Two clear edges that differ by far more than the pivot is off: what lies within the border of a
// bright blade is its bevel, though that looks like the ground, unless a bevel is seen within it. A
// dark blade may cast a shadow instead, and the view's tilt may part the edges.
TEST(BorrowInnerOne, TakesTheClearLineOfABrightBladeForItsBevelsThatIsNotSeen) {
  constexpr double kBrighter = -0.3, kClear = 0.3, kClosePx = 0.5;
  const SceneSpec spec = SceneWithMarkers();
  const auto borrowed = [&](double contrast, bool with_markers, double rival_px = 0) {
    Measured measured{spec};
    LocatedBlade& upper = measured.blades.upper;
    for (LocatedBlade* blade : {&upper, &measured.blades.lower}) {
      measured.Misplace(blade, blade == &upper ? -testing::kBevelPx : 0, contrast);
      Measured::MakeClear(blade);
    }
    if (rival_px != 0) upper.edge.ambiguity = kClear;
    upper.edge.rival_px = rival_px;
    measured.photo = Measured::PhotoOf(testing::Grained(testing::BareSheet()));
    if (!with_markers) measured.scale.sheet.reset();
    const MirrorLine line = LineBetween(measured.View(), measured.pivot, measured.blades);
    BorrowInnerOne(measured.View(), line, measured.pivot, &measured.blades);
    if (upper.moved.empty()) return false;
    EXPECT_LT(FarFrom(measured.truth.upper, upper.used), kClosePx);
    EXPECT_GT(upper.edge.common_sigma_px, testing::kBevelPx / 3);
    return true;
  };
  EXPECT_TRUE(borrowed(kBrighter, true));
  EXPECT_FALSE(borrowed(-kBrighter, true));
  EXPECT_FALSE(borrowed(kBrighter, false));
  EXPECT_TRUE(borrowed(kBrighter, true, testing::kBevelPx)) << "a line on the ground";
  EXPECT_FALSE(borrowed(kBrighter, true, -testing::kBevelPx)) << "the bevel's line";
}

// Of an edge far out that is darker than the ground, the inner one being seen to hide
// nothing further out; blades bent to one side differ as well.
TEST(BorrowOuterOne, TakesTheOuterOneForItsShadowsUnlessTheInnerOneMayBeABevels) {
  constexpr double kAsidePx = 12, kClosePx = 0.5, kBent = 0.005;
  const auto borrowed = [&](double contrast, const cv::Mat& picture, double unlikeness) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& upper = measured.blades.upper;
    measured.Misplace(&upper, kAsidePx, contrast);
    Measured::MakeClear(&measured.blades.lower);
    measured.pivot.unlikeness = unlikeness;
    measured.photo = Measured::PhotoOf(picture);
    BorrowOuterOne(measured.View(), measured.pivot, &measured.blades);
    EXPECT_EQ(upper.moved.empty(), FarFrom(measured.truth.upper, upper.used) > kClosePx);
    return !upper.moved.empty();
  };
  const cv::Mat shadowed = testing::WithShadowBeside(SceneWithMarkers(), kAsidePx);
  EXPECT_TRUE(borrowed(Measured::kStrong, shadowed, 0));
  EXPECT_FALSE(borrowed(-Measured::kStrong, shadowed, 0)) << "brighter than the ground";
  EXPECT_FALSE(borrowed(Measured::kStrong, testing::BareSheet(), 0)) << "nothing is seen of it";
  EXPECT_FALSE(borrowed(Measured::kStrong, shadowed, kBent));
}

// It is the curve that is told of the blade; the view's tilt may part the edges, too, which is
// said. It alone does where no other line is seen beside the edge.
TEST(RelocateUnlikeEdges, FindsTheUpperEdgeFurtherOutWithoutMarkers) {
  constexpr double kAsidePx = 25, kClosePx = 0.3, kDoubtPx = 8;
  for (const double ambiguity : {0.3, 0.1}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& upper = measured.blades.upper;
    measured.Misplace(&upper, -kAsidePx);
    upper.edge.ambiguity = ambiguity;
    measured.scale.sheet.reset();
    Relocate(&measured);
    EXPECT_EQ(upper.moved.empty(), ambiguity < 0.2) << upper.moved;
    if (upper.moved.empty()) continue;
    EXPECT_LT(FarFrom(measured.truth.upper, upper.used), kClosePx);
    EXPECT_GT(upper.edge.common_sigma_px, kDoubtPx);
  }
}

// The curve that is told of the blade is not the other one's, unless it is seen to end further out
// than it was found.
TEST(RelocateUnlikeEdges, TakesNoFaintStepForTheUpperEdgeWithoutMarkers) {
  constexpr double kClosePx = 0.5;
  for (const Bevelled blade : {Bevelled::kOver, Bevelled::kBeneath}) {
    Measured measured = WithMirroringBevelBelow(blade);
    measured.TurnOver();
    Relocate(&measured);
    const LocatedBlade& upper = measured.blades.upper;
    EXPECT_EQ(upper.moved.empty(), blade == Bevelled::kBeneath);
    if (!upper.moved.empty()) {
      EXPECT_LT(FarFrom(measured.truth.upper, upper.used), kClosePx);
    }
  }
}

// What parts them may be the pivot then.
TEST(RelocateUnlikeEdges, TakesNoFaintStepForEdgesThatDifferByLessThanThePivotIsSure) {
  constexpr double kVaguePx = 10;
  Measured measured = WithMirroringBevelBelow(Bevelled::kBeneath);
  measured.pivot.covariance_px2 *= kVaguePx * kVaguePx;
  Relocate(&measured);
  EXPECT_EQ(measured.blades.lower.moved, "");
}

// Beside the upper edge a line is drawn on the ground, faintly, where the other blade puts that
// edge as the pivot lies aside.
Measured WithLineWhereMirrored(double pivot_sigma_px) {
  constexpr double kAsidePx = 5, kBandPx = 40, kFaint = -8;
  const SceneSpec spec = SceneWithMarkers();
  Measured measured{spec};
  measured.photo = Measured::PhotoOf(testing::BrightenedAlongUpperEdge(
      spec, -kBandPx, -2 * kAsidePx, [&](double, double) { return kFaint; }));
  const Vector2d& axis = measured.truth.axis_px;
  measured.pivot.point_px += kAsidePx * Vector2d(-axis.y(), axis.x());
  measured.pivot.covariance_px2 *= pivot_sigma_px * pivot_sigma_px;
  measured.Compare();
  return measured;
}

TEST(RelocateUnlikeEdges, TakesNoVaguerEdgeWherePivotsThatLieAsideMayPutIt) {
  constexpr double kSurePx = 0.3, kUnsurePx = 2;
  for (const double pivot_sigma_px : {kSurePx, kUnsurePx}) {
    Measured measured = WithLineWhereMirrored(pivot_sigma_px);
    Relocate(&measured);
    EXPECT_EQ(measured.blades.upper.moved.empty(), pivot_sigma_px == kUnsurePx)
        << measured.pivot.asymmetry;
  }
}

// The other one may be something else's border.
TEST(RelocateUnlikeEdges, LeavesNoClearEdgeForWhereADoubtfulOnePutsIt) {
  constexpr double kSurePx = 0.3;
  for (const double ambiguity_of_other : {0.0, 0.9}) {
    Measured measured = WithLineWhereMirrored(kSurePx);
    Measured::MakeClear(&measured.blades.upper);
    Measured::MakeClear(&measured.blades.lower);
    measured.blades.lower.edge.ambiguity = ambiguity_of_other;
    Relocate(&measured);
    EXPECT_EQ(measured.blades.upper.moved.empty(), ambiguity_of_other > 0)
        << measured.blades.upper.moved;
  }
}

// As if light hardly stepped at the edge.
void MakeFaint(LocatedBlade* blade) {
  constexpr double kFaint = 0.001;
  for (LocatedEdgePoint& p : blade->edge.points) p.contrast = kFaint;
}

TEST(RelocateUnlikeEdges, LeavesNoClearEdgeForWhereOneThatHardlyShowsPutsIt) {
  constexpr double kSurePx = 0.3;
  for (const bool faint : {false, true}) {
    Measured measured = WithLineWhereMirrored(kSurePx);
    Measured::MakeClear(&measured.blades.upper);
    Measured::MakeClear(&measured.blades.lower);
    if (faint) MakeFaint(&measured.blades.lower);
    Relocate(&measured);
    EXPECT_EQ(measured.blades.upper.moved.empty(), faint) << measured.blades.upper.moved;
  }
}

TEST(RelocateUnlikeEdges, TakesNoBandForAShadowBecauseOfAnEdgeThatHardlyShows) {
  constexpr double kHardMm = 0.2;
  const SceneSpec spec = SceneWithShadow(62 * kDegree, 270 * kDegree, kHardMm);
  for (const bool faint : {false, true}) {
    Measured measured{spec, WithoutColours(spec)};
    Measured::MakeClear(&measured.blades.lower);
    if (faint) MakeFaint(&measured.blades.upper);
    Relocate(&measured);
    EXPECT_EQ(measured.blades.lower.moved.empty(), faint) << measured.blades.lower.moved;
  }
}

// As a bevel's line is a higher step than the border of a blade as bright as its ground.
TEST(RelocateUnlikeEdges, LeavesAClearEdgeForAHigherStepUnlessThePivotMayHavePartedThem) {
  constexpr double kAsidePx = 8, kSurePx = 0.3, kUnsurePx = 3;
  for (const double pivot_sigma_px : {kSurePx, kUnsurePx}) {
    Measured measured{SceneWithMarkers()};
    measured.Misplace(&measured.blades.upper, kAsidePx);
    Measured::MakeClear(&measured.blades.upper);
    measured.pivot.covariance_px2 *= pivot_sigma_px * pivot_sigma_px;
    Relocate(&measured);
    EXPECT_EQ(measured.blades.upper.moved.empty(), pivot_sigma_px == kUnsurePx)
        << measured.blades.upper.moved;
  }
}

// At no shadow's border does light fall, going outwards: what is within is a line on the blade.
TEST(RelocateUnlikeEdges, TakesNoClearEdgeAtWhichLightFallsToALineFurtherIn) {
  constexpr double kAsidePx = 8, kContrast = 0.1, kSurePx = 0.3;
  for (const double contrast : {kContrast, -kContrast}) {
    Measured measured{SceneWithMarkers()};
    measured.Misplace(&measured.blades.upper, kAsidePx, contrast);
    Measured::MakeClear(&measured.blades.upper);
    measured.pivot.covariance_px2 *= kSurePx * kSurePx;
    Relocate(&measured);
    EXPECT_EQ(measured.blades.upper.moved.empty(), contrast < 0) << measured.blades.upper.moved;
  }
}

// No shadow hides the edge of the blade beneath, nor does an oblique view.
TEST(RelocateUnlikeEdges, LeavesAClearEdgeForAFaintStepThatHidesTheOtherOneWithoutMarkers) {
  constexpr double kClosePx = 0.5, kWarned = 0.5;
  Measured measured = WithMirroringBevelBelow(Bevelled::kOver);
  LocatedBlade& inner = measured.blades.lower;
  Measured::MakeClear(&inner);
  Relocate(&measured);
  EXPECT_LT(FarFrom(measured.truth.upper, inner.used), kClosePx);
  EXPECT_GT(inner.edge.ambiguity, kWarned);
}

// An oblique view parts clear edges as well, but puts no step where the other one has it.
TEST(RelocateUnlikeEdges, DoubtsAClearEdgeForAFaintStepWithoutMarkers) {
  constexpr double kSharePx = 0.4 * testing::kBevelPx;
  for (const bool bevel_is_seen : {true, false}) {
    Measured measured = WithMirroringBevelBelow(Bevelled::kBeneath);
    LocatedBlade& inner = measured.blades.lower;
    Measured::MakeClear(&inner);
    if (!bevel_is_seen) measured.photo = Measured::PhotoOf(testing::Grained(testing::BareSheet()));
    Relocate(&measured);
    EXPECT_EQ(inner.moved, "");
    EXPECT_EQ(IsClear(inner.edge), !bevel_is_seen);
    EXPECT_EQ(inner.edge.common_sigma_px > kSharePx, bevel_is_seen);
  }
}

// Of a bevel that is dark near the crotch and mirrors the ground towards the tip a line within
// shows better there than its border.
TEST(RelocateUnlikeEdges, TakesTheBorderAsAWholeWhereWhatIsSeenThereStrays) {
  constexpr double kClosePx = 1.5, kDark = -25, kFaint = -3;
  constexpr double kDarkUntil = 0.6, kLinePx = 5;
  const SceneSpec spec = SceneWithMarkers();
  Measured measured{spec};
  LocatedBlade& upper = measured.blades.upper;
  measured.Misplace(&upper, -testing::kBevelPx);
  const auto light = [](double depth, double share) {
    return share < kDarkUntil || depth > kLinePx ? kDark : kFaint;
  };
  measured.photo = Measured::PhotoOf(
      testing::Grained(testing::BrightenedAlongUpperEdge(spec, 0, testing::kBevelPx, light)));
  Relocate(&measured);
  EXPECT_NE(upper.moved, "");
  EXPECT_LT(FarFrom(measured.truth.upper, DistalThird(upper)), kClosePx);
}

TEST(RelocateUnlikeEdges, LeavesAClearEdgeForAFaintStepInAViewOfKnownTilt) {
  constexpr double kClosePx = 0.5;
  const SceneSpec spec = SceneWithMarkers();
  Measured measured{spec};
  measured.Misplace(&measured.blades.upper, -testing::kBevelPx);
  Measured::MakeClear(&measured.blades.upper);
  measured.photo = Measured::PhotoOf(testing::WithMirroringBevel(spec));
  Relocate(&measured);
  EXPECT_NE(measured.blades.upper.moved, "");
  EXPECT_LT(FarFrom(measured.truth.upper, measured.blades.upper.used), kClosePx);
}

// Where the other edge is clear and this one is not: a trace that strayed into a ragged shadow.
TEST(RelocateUnlikeEdges, FindsALostEdgeWithoutMarkers) {
  constexpr double kAstrayPx = 70, kClosePx = 0.3, kWarned = 0.5;
  const auto relocated = [&](bool other_is_clear) {
    Measured measured{SceneWithMarkers()};
    measured.Lose(&measured.blades.lower, kAstrayPx);
    if (other_is_clear) Measured::MakeClear(&measured.blades.upper);
    if (!other_is_clear) measured.blades.upper.edge.ambiguity = 1;
    measured.scale.sheet.reset();
    Relocate(&measured);
    return measured;
  };
  const Measured measured = relocated(true);
  EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.used), kClosePx);
  EXPECT_GT(measured.blades.lower.edge.ambiguity, kWarned);
  const Measured both_unclear = relocated(false);
  EXPECT_GT(FarFrom(both_unclear.truth.lower, both_unclear.blades.lower.used), kAstrayPx / 2);
}

// They are no mirror images, and neither says where the other is.
TEST(RelocateUnlikeEdges, LeavesBladesBentToOneSide) {
  for (const double curve_mm : {1.0, -1.0}) {
    SceneSpec spec = SceneWithMarkers();
    spec.scissors.curve_mm = curve_mm;
    Measured measured{spec};
    const auto edges = [&] { return PairOf(measured.blades.upper, measured.blades.lower); };
    const std::vector<Vector2d> upper = PointsOf(measured.blades.upper);
    const std::vector<Vector2d> lower = PointsOf(measured.blades.lower);
    CompareEdges(measured.scale, measured.scene, edges(), &measured.pivot);
    EXPECT_TRUE(measured.pivot.bent) << curve_mm;
    EXPECT_EQ(measured.pivot.asymmetry, 0) << curve_mm;
    const double sigma_px = measured.blades.upper.edge.common_sigma_px;
    Relocate(&measured);
    EXPECT_EQ(PointsOf(measured.blades.upper), upper) << curve_mm;
    EXPECT_EQ(PointsOf(measured.blades.lower), lower) << curve_mm;
    EXPECT_EQ(measured.blades.upper.edge.common_sigma_px, sigma_px) << curve_mm;
    measured.blades.lower.edge.traced = true;  // and says nothing of a bend
    CompareEdges(measured.scale, measured.scene, edges(), &measured.pivot);
    EXPECT_FALSE(measured.pivot.bent) << curve_mm;
  }
}

// Without markers nobody knows from where the scissors are seen.
TEST(RelocateUnlikeEdges, TrustsNoMirrorInAViewOfUnknownTilt) {
  Measured measured{SceneWithMarkers()};
  measured.Misplace(&measured.blades.upper, 16);
  measured.scale.sheet.reset();
  const std::vector<Vector2d> before = PointsOf(measured.blades.upper);
  Relocate(&measured);
  EXPECT_EQ(PointsOf(measured.blades.upper), before);
}

// Unless they differ by little and one that has a rival is far better seen there: further in, where
// lines on the blade lie, by a far higher step.
TEST(RelocateUnlikeEdges, FindsTheFarBetterSeenEdgeWithoutMarkers) {
  constexpr double kAsidePx = 3, kFarPx = 16, kClosePx = 0.3, kWarned = 0.5;
  constexpr double kHigher = 2, kFarHigher = 5;  // the step at the edge, of that at what was found
  constexpr double kUnsure = 0.5;                // of the way: it may have been the edge
  const auto relocated = [&](bool upper, double outwards_px, double higher, double ambiguity) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& misplaced = measured.Blade(upper);
    const double contrast = TypicalContrast(misplaced.edge) / higher;
    measured.Misplace(&misplaced, outwards_px, contrast);
    misplaced.edge.ambiguity = ambiguity;
    measured.scale.sheet.reset();
    EXPECT_TRUE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    const bool is_found = FarFrom(measured.TrueEdge(upper), misplaced.used) < kClosePx;
    EXPECT_EQ(is_found, !misplaced.moved.empty());
    EXPECT_TRUE(!is_found || misplaced.edge.ambiguity > kWarned);
    const bool is_assumed = misplaced.moved == "where the other one puts it";
    EXPECT_TRUE(!is_assumed || TotalSigma(misplaced.edge) > kUnsure * std::abs(outwards_px));
    return is_found;
  };
  for (const bool upper : {true, false}) {
    EXPECT_TRUE(relocated(upper, -kAsidePx, kHigher, 0.6)) << upper;
    EXPECT_FALSE(relocated(upper, kAsidePx, kHigher, 0.6)) << upper;
    EXPECT_TRUE(relocated(upper, kAsidePx, kFarHigher, 0.6)) << upper;
    EXPECT_TRUE(relocated(upper, -kFarPx, kHigher, 0.6)) << upper;
    EXPECT_FALSE(relocated(upper, kFarPx, kFarHigher, 0.6)) << upper;
    EXPECT_FALSE(relocated(upper, kAsidePx, kFarHigher, 0.1))
        << upper << ": it was as clear before";
    EXPECT_TRUE(relocated(upper, -kAsidePx, kHigher, 0.1))
        << upper << ": now it is the mirror image";
  }
}

// But no view makes edges unlike in shape: the doubtful one strays.
TEST(RelocateUnlikeEdges, BorrowsTheDoubtfulEdgeOfUnlikeShapeWithoutMarkers) {
  constexpr double kStraysPx = 10, kClosePx = 0.3;
  for (const double doubt_of_other : {0.0, 0.4}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade &upper = measured.blades.upper, &lower = measured.blades.lower;
    Measured::MakeClear(&lower);
    lower.edge.ambiguity = doubt_of_other;
    Bulge(&measured, &upper, 0.6, 1, -kStraysPx);
    upper.edge.ambiguity = 0.9;
    upper.edge.common_sigma_px = 0.1;
    measured.scale.sheet.reset();
    ASSERT_FALSE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    const double off_px = FarFrom(measured.truth.upper, DistalThird(upper));
    EXPECT_EQ((off_px < kClosePx), (doubt_of_other == 0)) << off_px;
    EXPECT_GE(upper.edge.ambiguity, 0.6);
  }
}

// Nor if the part that strays makes them pass the pivot unlike, and nothing is seen elsewhere.
TEST(RelocateUnlikeEdges, BorrowsTheEdgeOfWhichSomeStraysSoFarThatTheyPassThePivotUnlike) {
  constexpr double kStraysPx = 10, kClosePx = 0.3;
  for (const bool with_markers : {true, false}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& lower = measured.blades.lower;
    Measured::MakeClear(&measured.blades.upper);
    Measured::MakeClear(&lower);
    measured.Shift(&lower, [&](double share) { return share < 0.5 ? 0 : -kStraysPx; });
    measured.photo = Measured::PhotoOf(testing::Grained(testing::BareSheet()));
    if (!with_markers) measured.scale.sheet.reset();
    ASSERT_TRUE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    EXPECT_LT(FarFrom(measured.truth.lower, DistalThird(lower)), kClosePx) << with_markers;
    EXPECT_GE(lower.edge.ambiguity, 0.6);
  }
}

// Where none is doubtful, either may.
TEST(RelocateUnlikeEdges, DoubtsBothEdgesOfUnlikeShapeWithoutMarkers) {
  constexpr double kBulgePx = 16;
  for (const bool unlike : {false, true}) {
    Measured measured{SceneWithMarkers()};
    if (unlike) Bulge(&measured, &measured.blades.upper, 0.65, 1, kBulgePx);
    measured.scale.sheet.reset();
    ASSERT_FALSE(AreSuspect(measured.pivot.asymmetry));
    Relocate(&measured);
    for (const LocatedBlade* blade : {&measured.blades.upper, &measured.blades.lower}) {
      EXPECT_EQ(blade->edge.ambiguity > 0.7, unlike);
      EXPECT_EQ(blade->edge.alone_sigma_px > 0.1 * kBulgePx, unlike);
    }
  }
}

// A line beside the edge was taken for it where the other one put it; the crotch is cut off since.
TEST(DoubtMovedEdges, ThatPassThePivotUnlikeByMoreThanItMayBeOff) {
  constexpr double kOffPx = 4, kDoubt = 0.7;
  const auto doubted = [&](double pivot_sigma_px, bool moved, bool with_markers) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& upper = measured.blades.upper;
    for (LocatedBlade* blade : {&upper, &measured.blades.lower}) measured.MakeClear(blade);
    measured.Misplace(&upper, kOffPx);
    if (moved) upper.moved = "where the other one puts it";
    if (!with_markers) measured.scale.sheet.reset();
    measured.pivot.covariance_px2 = pivot_sigma_px * pivot_sigma_px * Eigen::Matrix2d::Identity();
    DoubtMovedEdges(measured.View(), measured.pivot, &measured.blades);
    EXPECT_LT(measured.blades.lower.edge.ambiguity, kDoubt);
    return upper.edge.ambiguity > kDoubt && upper.edge.common_sigma_px > 0.8 * kOffPx;
  };
  EXPECT_TRUE(doubted(0.5, true, true));
  EXPECT_FALSE(doubted(2, true, true)) << "the pivot explains it";
  EXPECT_FALSE(doubted(0.5, false, true)) << "it was found there by itself";
  EXPECT_FALSE(doubted(0.5, true, false)) << "the view may explain it";
}

}  // namespace
}  // namespace bladecurve
