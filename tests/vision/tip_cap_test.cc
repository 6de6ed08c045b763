// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/tip_cap.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/scissors/distal_end.h"
#include "vision/scissors/followed_step.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kEdge = 100, kTip = 300, kWidth = 40;  // px: the edge's row, the tip's column

// A blade above the row kEdge, its tip an arc of `radius` that ends at kTip, its back slanting.
cv::Mat Blade(double radius) {
  constexpr int kFiner = 8;
  cv::Mat fine(160 * kFiner, 340 * kFiner, CV_8UC1, cv::Scalar(200));
  const auto at = [](double x, double y) {
    return cv::Point(cvRound((x + 0.5) * kFiner), cvRound((y + 0.5) * kFiner));
  };
  const double center = kTip - radius;
  const std::vector<cv::Point> body{at(-10, kEdge),
                                    at(center, kEdge),
                                    at(center, kEdge - 2 * radius),
                                    at(20, kEdge - kWidth),
                                    at(-10, kEdge - kWidth)};
  cv::fillPoly(fine, std::vector<std::vector<cv::Point>>{body}, 80);
  cv::circle(fine, at(center, kEdge - radius), cvRound(radius * kFiner), 80, cv::FILLED);
  cv::Mat picture;
  cv::resize(fine, picture, {340, 160}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(picture, picture, {}, 0.8);
  return picture;
}

// Straight along a row, from the crotch to the tip's column.
std::vector<Vector2d> EdgeAlong(double row) {
  std::vector<Vector2d> edge;
  for (double x = 20; x <= kTip; x += 1) edge.emplace_back(x, row);
  return edge;
}

const TipSearch kSearch{Vector2d(kTip, kEdge - 5), 12, kWidth, true};

TEST(FitTipCap, EndsWhereTheArcBegins) {
  constexpr double kAlong = 1.5, kAcross = 0.1, kRadius = 2;  // px
  for (const double radius : {5.0, 8.0, 12.0}) {
    const auto cap = FitTipCap(Blade(radius), EdgeAlong(kEdge), kSearch);
    ASSERT_TRUE(cap) << radius;
    EXPECT_NEAR(cap->end_px.x(), kTip - radius, kAlong) << radius;
    EXPECT_NEAR(cap->end_px.y(), kEdge, kAcross) << radius;
    EXPECT_NEAR(cap->radius_px, radius, kRadius) << radius;
  }
}

// Rounded off, a tip shows the lamp along its rim.
TEST(FitTipCap, EndsAtTheOuterSideOfABrightRim) {
  constexpr double kRadius = 8, kRimPx = 3, kClose = 0.7;
  constexpr uchar kMetal = 80, kGlint = 250;
  const Vector2d center(kTip - kRadius, kEdge - kRadius);
  for (const int ground : {60, 110, 140}) {
    cv::Mat picture(160, 340, CV_8UC1, cv::Scalar(ground));
    picture.setTo(kMetal, Blade(kRadius) < 140);
    picture.forEach<uchar>([&](uchar& value, const int* at) {
      const Vector2d from_center = Vector2d(at[1], at[0]) - center;
      const bool in_rim = from_center.x() > 0 && from_center.norm() > kRadius - kRimPx;
      if (in_rim && value == kMetal) value = kGlint;
    });
    cv::GaussianBlur(picture, picture, {}, 0.8);
    const auto cap = FitTipCap(picture, EdgeAlong(kEdge), kSearch);
    ASSERT_TRUE(cap) << ground;
    EXPECT_NEAR(cap->end_px.x(), kTip - kRadius, 2 * kClose) << ground;
    EXPECT_NEAR(cap->end_px.x() + cap->radius_px, kTip, kClose) << ground;
    EXPECT_LT(cap->step, 0) << ground;
  }
}

// A facet's border crosses the tip as an arc that leaves the edge long before it ends.
TEST(FitTipCap, BelievesTheEdgeThatGoesOnMoreThanAnArcInsideTheBlade) {
  constexpr double kAlong = 3;  // px
  cv::Mat picture = Blade(6);
  cv::Mat facet = cv::Mat::zeros(picture.size(), CV_8UC1);
  cv::circle(facet, {286 - 14, 100 - 16}, 16, 255, cv::FILLED);
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    if (at[1] > 272 && value < 120 && facet.at<uchar>(at[0], at[1]) == 0) value += 12;
  });
  const auto cap = FitTipCap(picture, EdgeAlong(kEdge), kSearch);
  ASSERT_TRUE(cap);
  EXPECT_NEAR(cap->end_px.x(), kTip - 6, kAlong);
}

// The blade with its shadow, which a lamp beyond the rings throws ahead of the tip.
cv::Mat BladeWithShadowAhead(double radius,
                             double ahead_px,
                             double penumbra_px,
                             double metal = 110,
                             double shade = 0.75) {  // grey; share of the light
  constexpr double kGround = 200;                    // grey
  const cv::Mat picture = Blade(radius);
  cv::Mat blade, shadow;
  picture.convertTo(blade, CV_64F, -1.0 / 120, 200.0 / 120);  // the blade's share of each pixel
  const cv::Mat ahead = (cv::Mat_<double>(2, 3) << 1, 0, ahead_px, 0, 1, 0);
  cv::warpAffine(blade, shadow, ahead, blade.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::GaussianBlur(shadow, shadow, {}, penumbra_px);
  const cv::Mat ground = kGround * (1 - shade * shadow);
  cv::Mat seen = blade * metal + ground.mul(1 - blade), grey;
  seen.convertTo(grey, CV_8U);
  return grey;
}

// As sharp as the blade, a dark strip ahead may as well be a bevel.
TEST(FitTipCap, TellsTheTipFromItsSoftShadow) {
  constexpr double kRadius = 12, kAheadPx = 16, kAlong = 2;
  TipSearch search = kSearch;
  search.tip_px.x() += kAheadPx;
  const auto cap = [&](double penumbra_px) {
    return FitTipCap(
        BladeWithShadowAhead(kRadius, kAheadPx, penumbra_px), EdgeAlong(kEdge), search);
  };
  const auto soft = cap(3), sharp = cap(0.1);
  ASSERT_TRUE(soft && sharp);
  EXPECT_TRUE(soft->in_shadow);
  EXPECT_NEAR(soft->end_px.x(), kTip - kRadius, kAlong);
  EXPECT_FALSE(sharp->in_shadow);
  EXPECT_NEAR(sharp->end_px.x(), kTip + kAheadPx - kRadius, kAlong);
}

TEST(FitTipCap, KnowsHowSharplyTheBladeEnds) {
  constexpr double kInFocus = 0.7, kClose = 0.1, kSoft = 0.5;
  const cv::Mat sharp = Blade(8);
  cv::Mat soft;
  cv::GaussianBlur(sharp, soft, {}, 3);
  const auto in_focus = FitTipCap(sharp, EdgeAlong(kEdge), kSearch);
  const auto out_of_focus = FitTipCap(soft, EdgeAlong(kEdge), kSearch);
  ASSERT_TRUE(in_focus && out_of_focus);
  EXPECT_NEAR(in_focus->sharpness, kInFocus, kClose);
  EXPECT_LT(out_of_focus->sharpness, kSoft);
}

// The step across the edge goes on along the shadow, which is darker than the blade.
TEST(FindDistalEnds, LeavesTheBladesSoftShadow) {
  constexpr double kRadius = 12, kAheadPx = 16, kAlong = 2;
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() += kAheadPx;
  const DistalEnd end =
      FindDistalEnds(BladeWithShadowAhead(kRadius, kAheadPx, 3), EdgeAlong(kEdge), search).likely;
  EXPECT_TRUE(end.arc_seen);
  EXPECT_GT(end.evidence, 0);
  EXPECT_NEAR(end.point_px.x(), kTip - kRadius, kAlong);
}

// A dark blade before its pale shadow, which ends softly; sharp, that may as well be the blade's
// end.
TEST(FindDistalEnds, KnowsTheSharpEndBeforeASoftOneForARival) {
  constexpr double kRadius = 5, kAheadPx = 20, kAlong = 2, kMetal = 40, kShade = 0.4;
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() += kAheadPx;
  const auto rivals = [&](double penumbra_px) {
    return FindDistalEnds(BladeWithShadowAhead(kRadius, kAheadPx, penumbra_px, kMetal, kShade),
                          EdgeAlong(kEdge),
                          search)
        .rivals;
  };
  const auto at_blade = [&](const DistalEnd& end) {
    return std::abs(end.point_px.x() - (kTip - kRadius)) < kAlong;
  };
  const auto soft = rivals(2), sharp = rivals(0.1);
  EXPECT_TRUE(std::any_of(soft.begin(), soft.end(), at_blade));
  EXPECT_TRUE(std::none_of(sharp.begin(), sharp.end(), at_blade));
}

TEST(FollowStep, EndsWithTheBladeWhereverTheTipWasPresumed) {
  constexpr double kRadius = 6, kClosePx = 5;
  std::vector<Vector2d> edge = EdgeAlong(kEdge);
  edge.resize(200);  // not followed to the end
  for (const double presumed : {250.0, 300.0, 330.0}) {
    TipSearch search = kSearch;
    search.tip_px.x() = presumed;
    const auto lost = FollowStep(Blade(kRadius), edge, search).end_px;
    ASSERT_TRUE(lost) << presumed;
    EXPECT_NEAR(lost->x(), kTip - kRadius / 2, kClosePx) << presumed;
  }
}

// Stripes across the edge of a blade that is as grey as they are, typically.
TEST(FollowStep, DoesNotFollowGrain) {
  constexpr int kStripePx = 3;
  constexpr double kStep = 12;
  const std::vector<Vector2d> edge = EdgeAlong(kEdge);
  for (const double grain : {6.0, 40.0}) {
    cv::Mat picture(160, 340, CV_8UC1);
    for (int row = 0; row < picture.rows; ++row) {
      for (int column = 0; column < picture.cols; ++column) {
        const bool ground = row > kEdge || column > kTip;
        const double stripe = (column / kStripePx % 3 - 1) * grain;
        picture.at<uchar>(row, column) =
            cv::saturate_cast<uchar>(ground ? 120 + kStep + stripe : 120.0);
      }
    }
    cv::GaussianBlur(picture, picture, {}, 0.8);
    EXPECT_EQ(FollowStep(picture, edge, kSearch).step != 0, grain < kStep) << grain;
  }
}

// Beyond a shadow 3 px wide the ground is brighter than the blade.
TEST(FollowStep, KnowsTheStepIntoANarrowShadow) {
  constexpr int kShadowPx = 3;
  constexpr double kBlurPx = 0.25;
  constexpr uchar kBlade = 110, kShade = 60, kGround = 220;
  cv::Mat picture(160, 340, CV_8UC1, cv::Scalar(kGround));
  const int first_below = static_cast<int>(kEdge) + 1;
  picture.rowRange(0, first_below) = kBlade;
  picture.rowRange(first_below, first_below + kShadowPx) = kShade;
  TipSearch search = kSearch;
  search.blur_px = kBlurPx;
  EXPECT_NEAR(FollowStep(picture, EdgeAlong(kEdge + 0.5), search).step, kShade - kBlade, 5);
}

// So far beyond the tip of a bright blade its shadow ends, along the border of which the edge was
// followed on.
constexpr double kFurtherPx = 24;
const TipSearch kAtShadowsTip{kSearch.tip_px + Vector2d(kFurtherPx, 0), 8, kWidth, true};

std::vector<Vector2d> EdgeIntoTheShadow() {
  std::vector<Vector2d> edge = EdgeAlong(kEdge);
  for (double x = kTip + 1; x < kTip + kFurtherPx; ++x) edge.emplace_back(x, kEdge);
  return edge;
}

// A tip too small to show an arc.
TEST(FindDistalEnds, LeavesTheSharpShadowOfABrightBlade) {
  constexpr double kRadius = 2, kAlong = 2, kMetal = 250, kShade = 0.4;
  const cv::Mat picture = BladeWithShadowAhead(kRadius, kFurtherPx, 0.1, kMetal, kShade);
  EXPECT_TRUE(FollowStep(picture, EdgeIntoTheShadow(), kAtShadowsTip).blade_ends);
  const DistalEnd end = FindDistalEnds(picture, EdgeIntoTheShadow(), {kAtShadowsTip, 0.05}).likely;
  EXPECT_NEAR(end.point_px.x(), kTip - kRadius, kAlong);
}

// A dark blade in the sun; its shadow lies beside the edge continued, and ends further on.
cv::Mat DarkBladeWithShadowAside(double radius, double further_px, double aside_px) {
  constexpr double kShade = 70;  // grey, darker than the blade
  const cv::Mat blade = Blade(radius);
  const cv::Mat moved = (cv::Mat_<double>(2, 3) << 1, 0, further_px, 0, 1, -aside_px);
  cv::Mat shadow, picture = blade.clone();
  cv::warpAffine(blade, shadow, moved, blade.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    if (value > 190 && shadow.at<uchar>(at[0], at[1]) < 190) value = kShade;
  });
  return picture;
}

TEST(FindDistalEnds, LeavesTheShadowBesideTheTipOfADarkBlade) {
  constexpr double kRadius = 6, kAside = 14, kAlong = 2.5;
  const cv::Mat picture = DarkBladeWithShadowAside(kRadius, kFurtherPx, kAside);
  TipSearch search = kAtShadowsTip;
  search.tip_px.y() -= kAside;
  EXPECT_TRUE(FollowStep(picture, EdgeAlong(kEdge), search).blade_ends);
  const DistalEnd end = FindDistalEnds(picture, EdgeAlong(kEdge), {search, 0.05}).likely;
  EXPECT_TRUE(end.arc_seen);
  EXPECT_NEAR(end.point_px.x(), kTip - kRadius, kAlong);
}

// The body of the blade tapers off to meet the edge where the bevel before it mirrors the ground.
TEST(FollowStep, SeesTheDarkBladeBehindABevelThatIsAsBrightAsTheGround) {
  constexpr int kBevelPx = 9, kFrom = 255, kGround = 200;
  cv::Mat picture = Blade(6);
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    const double taper = (kTip - at[1]) / (kTip - kFrom);
    if (at[1] > kFrom && at[0] > kEdge - kBevelPx * taper) value = kGround;
  });
  TipSearch search = kSearch;
  search.reach_px = 8;
  const FollowedStep followed = FollowStep(picture, EdgeAlong(kEdge), search);
  ASSERT_TRUE(followed.end_px);
  EXPECT_LT(followed.end_px->x(), kFrom + 5);
  EXPECT_FALSE(followed.blade_ends);
}

// A bevel that mirrors the ground, or a darker place: behind it there is the blade still.
TEST(FollowStep, SeesTheBladeBehindABevelThatIsAsDarkAsTheGround) {
  constexpr double kRadius = 10, kMetal = 250;
  constexpr int kBevelPx = 6, kFrom = 280;
  for (const int light : {200, 120}) {
    cv::Mat picture = BladeWithShadowAhead(kRadius, 0, 0.1, kMetal);
    const int edge = static_cast<int>(kEdge) + 1;
    picture(cv::Range(edge - kBevelPx, edge), cv::Range(kFrom, static_cast<int>(kTip))) = light;
    TipSearch search = kSearch;
    search.reach_px = 8;
    const FollowedStep followed = FollowStep(picture, EdgeAlong(kEdge), search);
    ASSERT_TRUE(followed.end_px) << light;
    EXPECT_LT(followed.end_px->x(), kFrom + 5) << light;
    EXPECT_FALSE(followed.blade_ends) << light;
  }
}

// The small picture lost the tip: no arc where it was presumed.
TEST(FindDistalEnds, GoesOnAsFarAsTheStepAcrossTheEdge) {
  constexpr double kRadius = 6, kShort = 40, kAlong = 2.5;
  std::vector<Vector2d> edge = EdgeAlong(kEdge);
  edge.resize(edge.size() - static_cast<std::size_t>(kShort));
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() = kTip - kShort;
  const DistalEnd end = FindDistalEnds(Blade(kRadius), edge, search).likely;
  EXPECT_TRUE(end.arc_seen);
  EXPECT_NEAR(end.point_px.x(), kTip - kRadius, kAlong);
}

// Where the bevel begins to mirror the ground, the points found may bend away from the edge.
TEST(FindDistalEnds, TakesNoBendForTheTipWhereTheStepGoesOn) {
  constexpr double kLost = 219, kBend = 15, kAway = 1.5;  // px
  cv::Mat picture(160, 340, CV_8UC1, cv::Scalar(200));
  const std::vector<cv::Point> needle{{-10, 100}, {300, 100}, {20, 60}, {-10, 60}};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{needle}, 80);
  cv::GaussianBlur(picture, picture, {}, 0.8);
  std::vector<Vector2d> edge = EdgeAlong(kEdge);
  edge.resize(200);
  for (Vector2d& p : edge) {
    const double beyond = std::max(0.0, (p.x() - kLost + kBend) / kBend);
    p.y() -= kAway * beyond * beyond;
  }
  const DistalEnd end = FindDistalEnds(picture, edge, {kSearch, 0.05}).likely;
  EXPECT_GT(end.point_px.x(), 0.5 * (kLost + kTip));
  EXPECT_GT(end.along_sigma_px, 0.4 * (kTip - kLost));
}

// The tip of a needle is as dark as the ground is in grey, but for the step across its edge: what
// is brighter ends before, on an arc.
TEST(FindDistalEnds, TakesNoArcForTheTipWhereTheStepGoesOn) {
  constexpr double kRadius = 8, kArcEnds = 240;
  cv::Mat picture(160, 340, CV_8UC1, cv::Scalar(200));
  const std::vector<cv::Point> needle{{-10, 100}, {300, 100}, {20, 60}, {-10, 60}};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{needle}, 80);
  const cv::Point center(static_cast<int>(kArcEnds - kRadius), static_cast<int>(kEdge - kRadius));
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    const bool is_beyond =
        at[1] > center.x && std::hypot(at[1] - center.x, at[0] - center.y) > kRadius;
    if (is_beyond && value == 80) value = 150;
  });
  cv::GaussianBlur(picture, picture, {}, 0.8);
  std::vector<Vector2d> edge = EdgeAlong(kEdge);
  edge.resize(static_cast<std::size_t>(kArcEnds - edge.front().x()));
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px = {kArcEnds, kEdge - kRadius};
  const DistalEnds ends = FindDistalEnds(picture, edge, search);
  EXPECT_GT(ends.likely.point_px.x(), kArcEnds + 0.3 * (kTip - kArcEnds));
  EXPECT_LT(kTip - ends.likely.point_px.x(), 3 * ends.likely.along_sigma_px);
  ASSERT_EQ(ends.rivals.size(), 1);
  EXPECT_NEAR(ends.rivals[0].point_px.x(), center.x, 3);
}

// A blade that hardly parts from white ground has grain like that; few lines end on it.
TEST(FindDistalEnds, TakesNoFleckForTheTipWhereTheEdgeDoesNotStandOut) {
  constexpr double kRadius = 8;
  const Vector2d center(kTip - 14, kEdge - kRadius);
  cv::Mat picture(160, 340, CV_8UC1, cv::Scalar(200));
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    const double depth = kEdge - at[0];
    const Vector2d from_center = Vector2d(at[1], at[0]) - center;
    if (depth > 1 && depth < 5 && from_center.x() > 0 && from_center.x() < 16 &&
        from_center.norm() > kRadius)
      value = 182;
  });
  cv::GaussianBlur(picture, picture, {}, 0.8);
  const DistalEnd end = FindDistalEnds(picture, EdgeAlong(kEdge), {kSearch, 0.05}).likely;
  EXPECT_FALSE(end.arc_seen);
  EXPECT_GT(end.along_sigma_px, 4);
}

// A soft or a hard shadow of the tip lies further on than the tip itself.
TEST(FindDistalEnds, KnowsTheTipFromTheArcOfItsShadow) {
  constexpr double kRadius = 8, kShadowPx = 20, kAlong = 2.5;
  const cv::Mat blade = Blade(kRadius);
  cv::Mat shadow;
  cv::warpAffine(blade,
                 shadow,
                 cv::Matx23d(1, 0, kShadowPx, 0, 1, 0),
                 blade.size(),
                 cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  cv::Mat picture = blade.clone();
  picture.forEach<uchar>([&](uchar& value, const int* at) {
    constexpr double kDepth = 0.25;  // of the blade's own step
    const double darker = kDepth * (200 - shadow.at<uchar>(at[0], at[1]));
    value = static_cast<uchar>(std::min<double>(value, 200 - darker));
  });
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() = kTip + kShadowPx;
  const DistalEnds ends = FindDistalEnds(picture, EdgeAlong(kEdge), search);
  ASSERT_EQ(ends.rivals.size(), 1);
  EXPECT_NEAR(ends.rivals[0].point_px.x(), kTip - kRadius, kAlong);
  EXPECT_GT(ends.rivals[0].evidence, 2 * ends.likely.evidence);
}

// The shadow of a bright blade's tip ends with a step that is none of the blade's.
DistalEnds EndsOfBrightBlade(double radius, int shadow_px, const cv::Rect& thread = {}) {
  constexpr uchar kBright = 220, kGround = 120, kShade = 60;
  cv::Mat wide, picture(160, 340 + shadow_px, CV_8UC1, cv::Scalar(kGround));
  cv::copyMakeBorder(Blade(radius) < 140, wide, 0, 0, shadow_px, shadow_px, cv::BORDER_REPLICATE);
  picture.setTo(kShade, wide.colRange(0, picture.cols));
  picture.setTo(kBright, wide.colRange(shadow_px, shadow_px + picture.cols));
  picture(thread) = kBright;
  cv::GaussianBlur(picture, picture, {}, 0.8);
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() = kTip + shadow_px;
  return FindDistalEnds(picture, EdgeAlong(kEdge), search);
}

TEST(FindDistalEnds, EndsWhereABrightBladeDoesFarBeforeItsShadow) {
  constexpr double kRadius = 8, kAlong = 2.5;
  const DistalEnds ends = EndsOfBrightBlade(kRadius, 30);
  EXPECT_NEAR(ends.likely.point_px.x(), kTip - kRadius, kAlong);
  EXPECT_GT(ends.likely.evidence, 0);
}

// With something bright in the shadow nobody knows whether the blade goes on.
TEST(FindDistalEnds, BelievesNoArcThatStepsTheOtherWay) {
  constexpr double kRadius = 8, kAlong = 2.5;
  constexpr int kShadowPx = 30;
  const cv::Rect thread(static_cast<int>(kTip) + 6, static_cast<int>(kEdge) - 16, 5, 10);
  const DistalEnds ends = EndsOfBrightBlade(kRadius, kShadowPx, thread);
  EXPECT_NEAR(ends.likely.point_px.x(), kTip + kShadowPx - kRadius, kAlong);
  EXPECT_EQ(ends.likely.evidence, 0);
  const auto is_at_tip = [&](const DistalEnd& end) {
    return std::abs(end.point_px.x() - (kTip - kRadius)) < kAlong && end.evidence > 0;
  };
  EXPECT_TRUE(std::any_of(ends.rivals.begin(), ends.rivals.end(), is_at_tip));
}

// Grain of the ground behind the blade was taken for its tip. On a wide blade the lines lie so far
// from each other that few meet the arc.
TEST(FindDistalEnds, LooksWhereTheEdgeIsLostFarBeforeThePresumedTip) {
  constexpr double kRadius = 8, kAlong = 2.5;  // px
  cv::Mat picture;
  cv::copyMakeBorder(Blade(kRadius), picture, 0, 0, 0, 160, cv::BORDER_CONSTANT, cv::Scalar(200));
  for (const double width_px : {kWidth, 2.2 * kWidth}) {
    EndSearch search{kSearch, 0.05};
    search.tip.tip_px.x() = kTip + 80;
    search.tip.blade_width_px = width_px;
    const DistalEnd end = FindDistalEnds(picture, EdgeAlong(kEdge), search).likely;
    EXPECT_TRUE(end.arc_seen) << width_px;
    EXPECT_NEAR(end.point_px.x(), kTip - kRadius, kAlong) << width_px;
  }
}

// A blade whose own end shows no arc: nobody knows where it ends.
TEST(FindDistalEnds, IsAsUncertainAsTheEdgeIsLostBeforeThePresumedTip) {
  constexpr double kLost = 80;  // px
  cv::Mat picture(160, 500, CV_8UC1, cv::Scalar(200));
  picture.rowRange(0, static_cast<int>(kEdge)) = 80;  // a step that goes on and on
  EndSearch search{kSearch, 0.05};
  search.tip.tip_px.x() = kTip + kLost;
  const DistalEnd end = FindDistalEnds(picture, EdgeAlong(kEdge), search).likely;
  EXPECT_FALSE(end.arc_seen);
  EXPECT_GT(end.along_sigma_px, 0.4 * kLost);
}

}  // namespace
}  // namespace bladecurve
