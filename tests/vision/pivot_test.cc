// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/pivot.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "measured_blades.h"
#include "vision/pivot/head_search.h"
#include "vision/refused.h"
#include "vision/scissors/consistency.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Measured;
using testing::SceneWithMarkers;

// As if a shadow filled the gap between the blades: the overlap seems to reach far ahead.
Scene WithCrotchAhead(Scene scene, double shares) {
  const Vector2d ahead = shares * (scene.crotch_px - scene.shank_crotch_px);
  scene.crotch_px += ahead;
  scene.pivot_px += 0.5 * ahead;
  return scene;
}

TEST(FindPivot, SeesTheScrewWhereverTheOverlapSeemsToBe) {
  constexpr double kClosePx = 1.5;  // the head stands above the edges' plane
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  for (const double shares : {0.0, 4.0}) {
    const Scene scene = WithCrotchAhead(measured.scene, shares);
    const std::optional<Screw> at_joint = LookAtJoint(measured.photo.grey(), measured.scale, scene);
    EXPECT_EQ(at_joint.has_value(), shares == 0);
    const Pivot pivot =
        FindPivot(measured.photo.grey(), measured.scale, {scene, edges, std::nullopt, at_joint});
    EXPECT_EQ(pivot.source, "screw") << shares;
    EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx) << shares;
  }
}

TEST(FindPivot, SeesAHeadAsWideAsTheWaistSeems) {
  constexpr double kClosePx = 1.5;
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  Scene scene = measured.scene;
  scene.shank_width_px = 18;  // across one shank alone; the head is 21 px wide
  ASSERT_FALSE(LookAtJoint(measured.photo.grey(), measured.scale, scene));
  const Pivot pivot =
      FindPivot(measured.photo.grey(), measured.scale, {scene, edges, std::nullopt, std::nullopt});
  EXPECT_EQ(pivot.source, "screw");
  EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
}

TEST(FindPivot, SeesASmallHeadOnABroadJoint) {
  constexpr double kClosePx = 1.5, kAsidePx = 10;
  Measured measured{SceneWithMarkers()};
  Scene scene = measured.scene;
  scene.shank_width_px = 110;  // the head is 21 px wide
  scene.left.width_px = scene.right.width_px = 60;
  ASSERT_FALSE(LookAtJoint(measured.photo.grey(), measured.scale, scene));
  const auto found = [&] {
    const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
    return FindPivot(
        measured.photo.grey(), measured.scale, {scene, edges, std::nullopt, std::nullopt});
  };
  const Pivot pivot = found();
  EXPECT_EQ(pivot.source, "screw");
  EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
  measured.Misplace(&measured.blades.upper, kAsidePx);
  EXPECT_EQ(found().source, "geometry") << "an engraved mark, then";
}

// Slender shanks, as wide as the mark: nothing but the blades tells that it is too small.
TEST(FindPivot, TakesNoMarkForTheHeadThatIsFarSmallerThanTheBladesAreWide) {
  constexpr int kMarkPx = 4, kFiner = 16, kBits = 4;
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.screw_visible = false;
  const Measured measured{spec};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  cv::Mat grey = measured.photo.grey().clone();
  const Vector2d at = kFiner * measured.truth.pivot_px;
  const cv::Point center(static_cast<int>(at.x()), static_cast<int>(at.y()));
  cv::circle(grey, center, kMarkPx * kFiner, 30, cv::FILLED, cv::LINE_AA, kBits);
  Scene scene = measured.scene;
  scene.shank_width_px = 24;
  for (const auto& [blade_px, source] : {std::pair(36, "screw"), std::pair(60, "geometry")}) {
    scene.left.width_px = scene.right.width_px = blade_px;
    const Pivot pivot = FindPivot(grey, measured.scale, {scene, edges, std::nullopt, std::nullopt});
    EXPECT_EQ(pivot.source, source) << blade_px;
  }
}

TEST(FindPivot, TakesAFaintHeadWithASlotAboutWhichTheEdgesMirrorEachOther) {
  constexpr double kClosePx = 1.5, kAsidePx = 10;
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.screw_radius_mm = 1.65;
  spec.sensor.noise_grey = 2.5;
  Measured measured{spec};
  const Scene scene = WithCrotchAhead(measured.scene, 4);  // the head is not where it is looked for
  const auto found = [&] {
    const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
    return FindPivot(measured.photo.grey(), measured.scale, {scene, edges, std::nullopt});
  };
  const Pivot pivot = found();
  ASSERT_TRUE(pivot.screw);
  EXPECT_LT(pivot.screw->evidence, kFaintHead);
  EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
  measured.Misplace(&measured.blades.upper, kAsidePx);
  EXPECT_EQ(found().source, "geometry");
}

// Where the view is not known the edges may mirror each other about anything; a faint head counts
// there where the blades alone put the pivot, not aside of it.
TEST(FindPivot, TakesAFaintestHeadInAKnownViewOrWhereTheBladesTurn) {
  constexpr double kClosePx = 1.5, kAsidePx = 10, kFaintest = 5;
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.screw_radius_mm = 1.3;
  spec.sensor.noise_grey = 3;
  Measured measured{spec};
  const Scene scene = WithCrotchAhead(measured.scene, 2);  // the head is not where it is looked for
  const auto found = [&](const ScaleResult& scale) {
    const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
    return FindPivot(measured.photo.grey(), scale, {scene, edges, std::nullopt});
  };
  ScaleResult unknown_view = measured.scale;
  unknown_view.sheet.reset();
  for (const ScaleResult& scale : {measured.scale, unknown_view}) {
    const Pivot pivot = found(scale);
    ASSERT_TRUE(pivot.screw);
    EXPECT_LT(pivot.screw->evidence, kFaintest);
    EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
  }
  measured.Misplace(&measured.blades.upper, kAsidePx);
  EXPECT_EQ(found(unknown_view).source, "geometry");
}

TEST(LookAtJoint, TakesNoFaintRoundThroughOrBeyondACrotchForAHead) {
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.screw_radius_mm = 1.65;
  spec.sensor.noise_grey = 1;
  const Measured measured{spec};
  const auto look = [&](double shanks_at, double blades_at) {  // ahead of the head, radii
    const Vector2d radius_px =
        spec.scissors.screw_radius_mm / measured.truth.mm_per_px * measured.truth.axis_px;
    Scene scene = measured.scene;
    scene.shank_crotch_px = measured.truth.screw_px + shanks_at * radius_px;
    scene.crotch_px = measured.truth.screw_px + blades_at * radius_px;
    return LookAtJoint(measured.photo.grey(), measured.scale, scene);
  };
  const std::optional<Screw> clear_of_crotches = look(-2, 2.5);
  ASSERT_TRUE(clear_of_crotches);
  EXPECT_LT(clear_of_crotches->evidence, kFaintHead);
  EXPECT_FALSE(look(-1, 1.5));
  EXPECT_TRUE(look(-0.5, 1.5));
  EXPECT_FALSE(look(0.5, 1.5));
  EXPECT_FALSE(look(-1.5, -0.5));
}

// A rim seen where none is, aside of the line about which the blades mirror each other.
Screw HeadAside(const Measured& measured, double evidence) {
  constexpr double kAsidePx = 20, kRadiusPx = 10;
  const Vector2d& axis = measured.truth.axis_px;
  Screw screw;
  screw.center_px = measured.truth.screw_px + kAsidePx * Vector2d(-axis.y(), axis.x());
  screw.covariance_px2.setIdentity();
  screw.semi_major_px = screw.semi_minor_px = kRadiusPx;
  screw.evidence = evidence;
  return screw;
}

TEST(FindPivot, LeavesAFaintHeadAsideForTheOneAboutWhichTheEdgesMirrorEachOther) {
  constexpr double kClosePx = 1.5, kFarPx = 15;
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const Scene scene = WithCrotchAhead(measured.scene, 4);  // the head is not where it is looked for
  const auto off_px = [&](const Screw& at_joint) {
    const PivotSearch search{scene, edges, std::nullopt, at_joint};
    const Pivot pivot = FindPivot(measured.photo.grey(), measured.scale, search);
    return (pivot.point_px - measured.truth.pivot_px).norm();
  };
  EXPECT_LT(off_px(HeadAside(measured, kFaintHead - 1)), kClosePx);
  EXPECT_GT(off_px(HeadAside(measured, kFaintHead + 1)), kFarPx);  // it is seen: the edges err
  Screw in_line = HeadAside(measured, kFaintHead - 1);
  in_line.center_px = measured.truth.screw_px - kFarPx * measured.truth.axis_px;
  // The edges have nothing against it, but the true one is clearer.
  EXPECT_LT(off_px(in_line), kClosePx);
}

constexpr int kFractionBits = 6;  // of a pixel, in drawings
int Fixed(double px) { return static_cast<int>(std::lround(std::ldexp(px, kFractionBits))); }
cv::Point Fixed(const Vector2d& at) { return {Fixed(at.x()), Fixed(at.y())}; }

cv::Mat WithoutHead(const Measured& measured) {
  constexpr double kHeadPx = 14;
  constexpr int kBroaderThanHead = 41;
  cv::Mat grey = measured.photo.grey().clone(), metal, head(grey.size(), CV_8U, cv::Scalar(0));
  cv::circle(head,
             Fixed(measured.truth.screw_px),
             Fixed(kHeadPx),
             255,
             cv::FILLED,
             cv::LINE_AA,
             kFractionBits);
  cv::medianBlur(grey, metal, kBroaderThanHead);
  metal.copyTo(grey, head);
  return grey;
}

TEST(FindPivot, TakesAFaintHeadNearALineAboutWhichTheEdgesMirrorEachOther) {
  constexpr double kAsidePx = 4;
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const Vector2d& axis = measured.truth.axis_px;
  const auto source = [&](double sigma_px) {
    Screw screw = HeadAside(measured, kFaintHead - 1);
    screw.center_px = measured.truth.screw_px + kAsidePx * Vector2d(-axis.y(), axis.x());
    screw.covariance_px2 *= sigma_px * sigma_px;
    const PivotSearch search{measured.scene, edges, std::nullopt, screw};
    return FindPivot(WithoutHead(measured), measured.scale, search).source;
  };
  EXPECT_EQ(source(0.1 * kAsidePx), "geometry");
  EXPECT_EQ(source(1.2 * kAsidePx), "screw");
}

struct Arc {
  double radius_px = 10, deg = 215, grey = 230;
  int width_px = 2;
};

TEST(FindPivot, ObeysAHintAndSaysThatAScrewIsSeenElsewhere) {
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const auto off_screw = [&](const cv::Mat& grey, double aside_px) {
    const Vector2d hint_px = measured.truth.screw_px + aside_px * measured.truth.axis_px;
    const Pivot pivot = FindPivot(grey, measured.scale, {measured.scene, edges, hint_px});
    EXPECT_EQ(pivot.source, "hint");
    EXPECT_EQ(pivot.point_px, hint_px);
    return pivot.off_screw;
  };
  EXPECT_FALSE(off_screw(measured.photo.grey(), 2));
  EXPECT_TRUE(off_screw(measured.photo.grey(), 5));
  EXPECT_TRUE(off_screw(measured.photo.grey(), -40));
  EXPECT_FALSE(off_screw(WithoutHead(measured), 5));
}

// The head gone, but for an arc of a rim about a place, as a low light leaves of it.
cv::Mat WithArcForHead(const Measured& measured, const Vector2d& center_px, const Arc& arc = {}) {
  cv::Mat grey = WithoutHead(measured);
  const cv::Size axes(Fixed(arc.radius_px), Fixed(arc.radius_px));
  cv::ellipse(grey,
              Fixed(center_px),
              axes,
              0,
              0,
              arc.deg,
              arc.grey,
              arc.width_px,
              cv::LINE_AA,
              kFractionBits);
  return grey;
}

TEST(FindPivot, SeesAHalfLitHeadAboutWhichTheEdgesMirrorEachOther) {
  constexpr double kClosePx = 1.5, kAsidePx = 8;
  const Measured measured{SceneWithMarkers()};
  const PivotSearch search{
      measured.scene, PairOf(measured.blades.upper, measured.blades.lower), std::nullopt};
  const Vector2d head = measured.truth.screw_px, axis = measured.truth.axis_px;
  const Pivot pivot = FindPivot(WithArcForHead(measured, head), measured.scale, search);
  EXPECT_EQ(pivot.source, "screw");
  EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
  const Vector2d aside = head + kAsidePx * Vector2d(-axis.y(), axis.x());
  EXPECT_EQ(FindPivot(WithArcForHead(measured, aside), measured.scale, search).source, "geometry");
}

// A joint with bright bars across such places, as slots of heads that do not show mirror the light.
cv::Mat WithBars(const Measured& measured, const std::vector<Vector2d>& middles_px) {
  constexpr int kFractionBits = 4;
  constexpr double kFiner = 1 << kFractionBits, kBlurPx = 0.8;
  const Vector2d half(6, 5);
  cv::Mat grey = measured.photo.grey().clone();
  const auto fine = [&](const Vector2d& p) {
    return cv::Point(cv::Point2d(kFiner * p.x(), kFiner * p.y()));
  };
  for (const Vector2d& middle : middles_px)
    cv::line(grey, fine(middle - half), fine(middle + half), 240, 2, cv::LINE_AA, kFractionBits);
  cv::GaussianBlur(grey, grey, {}, kBlurPx);
  return grey;
}

// Within what a slanted view parts the edges by about a head, there may be one. Of two bars either
// may be a step at a blade's heel, as what lies further aside is.
TEST(FindPivot, TakesALoneBrightBarForTheSlotOfAHeadWhereTheBladesTurn) {
  constexpr double kClosePx = 0.5;
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.screw_visible = false;
  const Measured measured{spec};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  ScaleResult unknown_view = measured.scale;
  unknown_view.sheet.reset();
  const Vector2d along = measured.truth.axis_px, across(-along.y(), along.x());
  const Pivot by_blades = PivotByBlades(unknown_view, measured.scene, edges);
  const auto off = [&](const Vector2d& direction, double sigmas) {
    const double sigma_px = std::sqrt(direction.dot(by_blades.covariance_px2 * direction));
    return (sigmas * sigma_px * direction).eval();
  };
  const auto place = [&](double sigmas_along, double sigmas_aside) {
    return (by_blades.point_px + off(along, sigmas_along) + off(across, sigmas_aside)).eval();
  };
  const auto find = [&](const std::vector<Vector2d>& middles_px) {
    return FindPivot(WithBars(measured, middles_px),
                     unknown_view,
                     {measured.scene, edges, std::nullopt, std::nullopt});
  };
  const Vector2d slot = place(-1.2, 0.5);
  const Pivot pivot = find({slot});
  ASSERT_TRUE(pivot.screw);
  EXPECT_TRUE(IsFaint(*pivot.screw)) << "it may be something else";
  EXPECT_LT((pivot.point_px - slot).norm(), kClosePx);
  EXPECT_EQ(find({slot, place(0.8, 0.5)}).source, "geometry");
  EXPECT_EQ(find({place(0, 1.4)}).source, "geometry");
  EXPECT_EQ(find({place(1.9, 0)}).source, "geometry");
}

// In an unknown view, aside of the line about which the edges mirror each other.
TEST(FindPivot, TakesAnArcForAHalfLitHeadRightWhereTheBladesTurn) {
  constexpr Arc kArc{7, 220, 215, 1};
  constexpr double kQuarterPx = 0.25 * kArc.radius_px, kSigmasAside = 0.6;
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  ScaleResult unknown_view = measured.scale;
  unknown_view.sheet.reset();
  const Pivot by_blades = PivotByBlades(unknown_view, measured.scene, edges);
  const Vector2d along = measured.truth.axis_px, across(-along.y(), along.x());
  const auto sigma_px = [&](const Vector2d& direction) {
    return std::sqrt(direction.dot(by_blades.covariance_px2 * direction));
  };
  const auto place = [&](double sigmas_along) {
    return by_blades.point_px + sigmas_along * sigma_px(along) * along +
           kSigmasAside * sigma_px(across) * across;
  };
  const auto find = [&](const Vector2d& center_px) {
    const cv::Mat grey = WithArcForHead(measured, center_px, kArc);
    return FindPivot(grey, unknown_view, {measured.scene, edges, std::nullopt, std::nullopt});
  };
  for (const double sigmas : {-0.5, 0.0, 0.5}) {
    const Pivot pivot = find(place(sigmas));
    EXPECT_EQ(pivot.source, "screw") << sigmas;
    EXPECT_LT((pivot.point_px - place(sigmas)).norm(), kQuarterPx) << sigmas;
    EXPECT_GT(along.dot(pivot.covariance_px2 * along), kQuarterPx * kQuarterPx) << sigmas;
  }
  for (const double sigmas : {-2.0, 2.0})
    EXPECT_EQ(find(place(sigmas)).source, "geometry") << sigmas;
  Scene doubtful = measured.scene;
  doubtful.outlined = true;
  EXPECT_EQ(FindPivot(WithArcForHead(measured, place(0), kArc),
                      unknown_view,
                      {doubtful, edges, std::nullopt, std::nullopt})
                .source,
            "geometry");
}

// Of which no more than a line shows, a pixel wide.
TEST(FindPivot, SeesTheFineRimOfAFlushHead) {
  constexpr double kClosePx = 1;
  constexpr int kRadiusPx = 28, kFiner = 16, kBits = 4, kDarker = 4;
  SceneSpec spec = SceneWithMarkers();
  spec.width = 3000;
  spec.height = 2250;
  spec.camera.mm_per_px = 0.1;
  spec.scissors.brushing = 0;
  spec.scissors.screw_visible = false;
  const Measured measured{spec};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  Scene scene = measured.scene;
  scene.pivot_px = measured.truth.pivot_px;
  const auto source = [&](const cv::Mat& grey) {
    const Pivot pivot = FindPivot(grey, measured.scale, {scene, edges, std::nullopt});
    if (pivot.source == "screw") {
      EXPECT_LT((pivot.screw->center_px - measured.truth.pivot_px).norm(), kClosePx);
    }
    return pivot.source;
  };
  const cv::Mat bare = measured.photo.grey();
  EXPECT_EQ(source(bare), "geometry");
  cv::Mat line = cv::Mat::zeros(bare.size(), CV_8UC1);
  const Vector2d at = kFiner * measured.truth.pivot_px;
  cv::circle(line,
             {static_cast<int>(at.x()), static_cast<int>(at.y())},
             kFiner * kRadiusPx,
             kDarker,
             1,
             cv::LINE_AA,
             kBits);
  EXPECT_EQ(source(bare - line), "screw");
}

// A photograph a few hundred pixels wide, its screw's slot some way round.
SceneSpec SmallPhotograph(double mm_per_px, std::uint64_t seed) {
  SceneSpec spec = SceneWithMarkers();
  spec.width = static_cast<int>(300 / mm_per_px);
  spec.height = static_cast<int>(225 / mm_per_px);
  spec.camera.mm_per_px = mm_per_px;
  spec.scissors.screw_radius_mm = 2.3;
  spec.scissors.slot_rad = 0.4 * static_cast<double>(seed);
  spec.sensor.noise_grey = 1.5;
  spec.seed = seed;
  return spec;
}

// Of which nothing is seen at their size.
TEST(FindPivot, SeesSmallHeadsMagnified) {
  constexpr double kClosePx = 0.5;
  for (const SceneSpec& spec :
       {SmallPhotograph(0.4, 5), SmallPhotograph(0.4, 6), SmallPhotograph(0.5, 4)}) {
    const Measured measured{spec};
    const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
    const Pivot pivot =
        FindPivot(measured.photo.grey(), measured.scale, {measured.scene, edges, std::nullopt});
    EXPECT_EQ(pivot.source, "screw");
    EXPECT_LT((pivot.point_px - measured.truth.pivot_px).norm(), kClosePx);
  }
}

// A slanted view parts them as well.
TEST(FindPivot, SeesSmallHeadsMagnifiedInAnUnknownViewAboutWhichTheEdgesAreUnlike) {
  constexpr double kClosePx = 1, kAsidePx = 10;
  Measured measured{SmallPhotograph(0.4, 5)};
  ScaleResult unknown_view = measured.scale;
  unknown_view.sheet.reset();
  measured.Misplace(&measured.blades.upper, kAsidePx);
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const auto find = [&](const ScaleResult& scale) {
    return FindPivot(measured.photo.grey(), scale, {measured.scene, edges, std::nullopt});
  };
  const Pivot pivot = find(unknown_view);
  EXPECT_EQ(pivot.source, "screw");
  EXPECT_LT((pivot.point_px - measured.truth.screw_px).norm(), kClosePx);
  EXPECT_EQ(find(measured.scale).source, "geometry");
}

// Smaller than heads are for so wide a shank, off where the overlap seems to be.
TEST(FindPivot, SeesASmallHeadThatNothingElseLooksLikeRightWhereTheBladesTurn) {
  constexpr Arc kHead{6.5, 360, 215, cv::FILLED};
  constexpr double kClosePx = 0.5, kShankPx = 64, kBladePx = 60, kAsidePx = 30;
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  ScaleResult unknown_view = measured.scale;
  unknown_view.sheet.reset();
  Scene scene = measured.scene;
  scene.shank_width_px = kShankPx;
  scene.left.width_px = scene.right.width_px = kBladePx;
  const Vector2d along = measured.truth.axis_px, across(-along.y(), along.x());
  for (Vector2d* crotch : {&scene.crotch_px, &scene.shank_crotch_px}) *crotch += kAsidePx * across;
  const Vector2d head = PivotByBlades(unknown_view, scene, edges).point_px;
  const cv::Mat grey = WithArcForHead(measured, head, kHead);
  const Pivot pivot = FindPivot(grey, unknown_view, {scene, edges, std::nullopt, std::nullopt});
  EXPECT_EQ(pivot.source, "screw");
  EXPECT_LT((pivot.point_px - head).norm(), kClosePx);
  EXPECT_LT(pivot.SigmaPx(), kClosePx);
}

TEST(FindPivot, DoubtsTheCentreMoreWhereAThirdOfTheRimIsUnlikeTheRest) {
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const auto variance_px2 = [&](double third_support) {
    Screw screw = HeadAside(measured, 2 * kBeyondDoubt);
    screw.covariance_px2 *= 1e-6;  // so that the rest shows
    screw.third_support = third_support;
    const PivotSearch search{measured.scene, edges, std::nullopt, screw};
    return FindPivot(measured.photo.grey(), measured.scale, search).covariance_px2.trace();
  };
  const double alike = variance_px2(1), between = variance_px2(0.6), unlike = variance_px2(0.3);
  EXPECT_LT(alike, between);
  EXPECT_LT(between, unlike);
  EXPECT_EQ(variance_px2(0.8), alike);
}

TEST(FindPivot, SaysHowFarTheHeadLiesFromWhereTheBladesPutIt) {
  const Measured measured{SceneWithMarkers()};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const auto off_geometry = [&](const Vector2d& by_px) {
    Screw screw = HeadAside(measured, 2 * kBeyondDoubt);
    screw.center_px = measured.truth.screw_px + by_px;
    const PivotSearch search{measured.scene, edges, std::nullopt, screw};
    return FindPivot(measured.photo.grey(), measured.scale, search).off_geometry;
  };
  EXPECT_LT(off_geometry(Vector2d::Zero()), 2);
  EXPECT_GT(off_geometry(40 * measured.truth.axis_px), 3);
  EXPECT_EQ(PivotByBlades(measured.scale, measured.scene, edges).off_geometry, 0);
}

TEST(FindPivot, SeesASlotWhereItIsCut) {
  constexpr double kClose = 0.03;  // of the radius
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.slot_off = {0, 0.1};
  spec.scissors.screw_mm = 3;  // the head moves in the tilted view
  const Measured measured{spec};
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  const Pivot pivot = FindPivot(
      measured.photo.grey(), measured.scale, {measured.scene, edges, std::nullopt, std::nullopt});
  ASSERT_TRUE(pivot.screw && pivot.screw->slot);
  const double off_px = (pivot.screw->slot->center_px - measured.truth.screw_px).norm();
  EXPECT_NEAR(off_px / pivot.screw->semi_major_px, spec.scissors.slot_off.norm(), kClose);
  EXPECT_GT((measured.truth.screw_px - TruthOf(SceneWithMarkers()).screw_px).norm(), 0.2);
}

TEST(CompareEdges, TellsAClampsJawsFromEdgesThatPassByThePivot) {
  constexpr double kBevelPx = 16;
  Measured measured{SceneWithMarkers()};
  const auto compare = [&] {
    const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
    CompareEdges(measured.scale, measured.scene, edges, &measured.pivot);
    RefuseInconsistent(measured.pivot, measured.blades);
  };
  const LocatedBlade edge = measured.blades.upper;
  measured.Misplace(&measured.blades.upper, -kBevelPx);
  EXPECT_THROW(compare(), Refused);
  measured.blades.upper = edge;
  EXPECT_NO_THROW(compare());
  EXPECT_TRUE(AreAlike(measured.pivot.asymmetry));
}

TEST(PivotByBlades, TakesNoNoticeOfTheScrewAndSaysHowVagueThatIs) {
  const Measured measured{SceneWithMarkers()};
  const Pivot pivot = PivotByBlades(
      measured.scale, measured.scene, PairOf(measured.blades.upper, measured.blades.lower));
  EXPECT_EQ(pivot.source, "geometry");
  EXPECT_FALSE(pivot.screw.has_value());
  EXPECT_TRUE(AreAlike(pivot.asymmetry)) << pivot.asymmetry;
  const Vector2d off = pivot.point_px - measured.truth.pivot_px;
  constexpr double kChiSquare = 9.21;  // of two coordinates, 99 %
  EXPECT_LT(off.dot(pivot.covariance_px2.ldlt().solve(off)), kChiSquare);
  EXPECT_GT(pivot.covariance_px2.trace(), 25);
}

}  // namespace
}  // namespace bladecurve
