// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Edges that grey hides and colour shows, and dark bands told apart by their colour or pattern.
#include "vision/edge/edge_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/edge/colour_border.h"
#include "vision/edge/edge_shadow.h"
#include "vision/edge_images.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Gaussian;
using testing::Smooth;

constexpr int kPatternSide = 200;
constexpr double kChannelNoise = 1.5;  // grey values, each channel by itself

const Vector2d kNormal(std::cos(0.4), std::sin(0.4));  // out of the blade
constexpr double kOffset = 132;                        // of the blade's border along it

// BGR whose light, 0 to 255 linear, depends on the distance from the blade's border, and on the
// place.
cv::Mat Patterned(Gaussian& random, const std::function<Vector3d(double, const Vector2d&)>& light) {
  cv::Mat picture(kPatternSide, kPatternSide, CV_8UC3);
  for (int y = 0; y < kPatternSide; ++y) {
    for (int x = 0; x < kPatternSide; ++x) {
      const Vector3d at = light(kNormal.dot(Vector2d(x, y)) - kOffset, {x, y});
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(at[c] + kChannelNoise * random());
    }
  }
  return picture;
}

cv::Mat Coloured(Gaussian& random, const std::function<Vector3d(double)>& light) {
  return Patterned(random, [&](double d, const Vector2d&) { return light(d); });
}

EdgeGuess GuessOff(double px) {
  const Vector2d along(-kNormal.y(), kNormal.x());
  const Vector2d middle = (kOffset + px) * kNormal + 40 * along;
  EdgeGuess guess;
  guess.path_px = {middle - 70 * along, middle + 70 * along};
  guess.blade_on_left = false;  // left of (-ny, nx) is (nx, ny): background
  return guess;
}

double MeanOffset(const LocatedEdge& edge) {
  double sum = 0, count = 0;
  for (const LocatedEdgePoint& point : edge.points) {
    if (!point.inlier) continue;
    sum += kNormal.dot(point.point_px) - kOffset;
    ++count;
  }
  return sum / count;
}

// Colours are stored at half the resolution, in blocks.
TEST(ColourView, ShowsASoftEdgeAmongTheBordersOfBlocks) {
  constexpr double kBlurPx = 3, kClosePx = 0.8, kBlock = 8, kUneven = 13;
  Gaussian random(2);
  ColourView view;
  view.grey.create(kPatternSide, kPatternSide, CV_8UC1);
  view.tone = testing::GammaCurve(1);
  view.corner_px = {10, 20};
  cv::Mat blocks(
      kPatternSide / static_cast<int>(kBlock), kPatternSide / static_cast<int>(kBlock), CV_64F);
  for (auto it = blocks.begin<double>(); it != blocks.end<double>(); ++it) *it = random();
  for (int y = 0; y < kPatternSide; ++y) {
    for (int x = 0; x < kPatternSide; ++x) {
      const double from_edge = kNormal.dot(Vector2d(x, y) + view.corner_px) - kOffset;
      const double ground = Smooth(from_edge * 0.8 / kBlurPx);
      const double uneven =
          blocks.at<double>(y / static_cast<int>(kBlock), x / static_cast<int>(kBlock));
      view.grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(90 + ground * (70 + kUneven * uneven) +
                                                           kChannelNoise * random());
    }
  }
  EXPECT_THROW((void)LocateEdgeInView(view, GuessOff(2)), Refused);
  const LocatedEdge edge = LocateEdgeInHalvedView(view, GuessOff(2));
  EXPECT_NEAR(MeanOffset(edge), 0, kClosePx);
  EXPECT_GT(edge.common_sigma_px, kClosePx / 2);
}

TEST(ColourView, ShowsAnEdgeBetweenColoursOfOneGrey) {
  constexpr double kClose = 0.03;                             // px
  const Vector3d steel(120, 110, 100), drape(150, 100, 108);  // luma 108, within one grey value
  Gaussian random(1);
  const cv::Mat bgr =
      Coloured(random, [&](double d) { return steel + Smooth(d) * (drape - steel); });
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  const ToneCurve linear = testing::GammaCurve(1);
  const EdgeGuess guess = GuessOff(2);
  EXPECT_THROW((void)LocateEdge(grey, linear, guess), Refused);
  EXPECT_LT(GreySeparation(grey, linear, guess), 1);

  const ColourView view = ViewWhereSidesDiffer(bgr, linear, guess);
  EXPECT_GT(view.separation, 5);
  EXPECT_NEAR(MeanOffset(LocateEdgeInView(view, guess)), 0, kClose);
}

TEST(ColourView, SaysWhenColourDoesNotHelp) {
  const Vector3d steel(100, 100, 100);
  Gaussian random(2);
  const cv::Mat bgr = Coloured(random, [&](double) { return steel; });
  const ColourView view = ViewWhereSidesDiffer(bgr, testing::GammaCurve(1), GuessOff(0));
  EXPECT_LT(view.separation, 1);
}

TEST(ColourView, OfAPartSeesTheSameWithinAndRefusesWhatLiesOutside) {
  constexpr double kClose = 0.05;  // px
  const Vector3d steel(120, 110, 100), drape(155, 105, 113);
  Gaussian random(3);
  const cv::Mat bgr =
      Coloured(random, [&](double d) { return steel + Smooth(d) * (drape - steel); });
  const ToneCurve linear = testing::GammaCurve(1);
  const cv::Rect area(40, 6, 150, 190);
  const PicturePart part(bgr(area), area.tl());
  const EdgeGuess guess = GuessOff(2);
  const LocatedEdge in_part = LocateEdgeInView(ViewWhereSidesDiffer(part, linear, guess), guess);
  const LocatedEdge in_all = LocateEdgeInView(ViewWhereSidesDiffer(bgr, linear, guess), guess);
  EXPECT_NEAR(MeanOffset(in_part), MeanOffset(in_all), kClose);

  EdgeGuess outside = guess;
  for (Vector2d& p : outside.path_px) p += Vector2d(1000, 0);
  const ColourView nothing = ViewWhereSidesDiffer(part, linear, outside);
  EXPECT_EQ(nothing.separation, 0);
  EXPECT_THROW((void)LocateEdgeInView(nothing, outside), Refused);
  EXPECT_THROW((void)LocateEdgeInHalvedView(nothing, outside), Refused);
}

// An edge at the border of a band that begins 9 px further in.
LocatedEdge OutsideABand() {
  constexpr double kWide = 9;
  const Vector2d along(-kNormal.y(), kNormal.x());
  LocatedEdge edge;
  for (int i = -60; i <= 60; ++i) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = kOffset * kNormal + (40 + i) * along;
    point.normal = kNormal;
    edge.points.push_back(point);
  }
  edge.rival_px = -kWide;
  return edge;
}

DarkBand JudgeIn(const cv::Mat& bgr, double width_px, const std::vector<Vector2d>& other_px = {}) {
  constexpr double kBladePx = 60;
  LocatedEdge edge = OutsideABand();
  edge.rival_px = -width_px;
  return JudgeDarkBand(bgr, testing::GammaCurve(1), edge, kBladePx, other_px);
}

DarkBand Judge(const Vector3d& blade,
               const Vector3d& band,
               const Vector3d& ground,
               double width_px = 9) {
  Gaussian random(3);
  const cv::Mat bgr = Coloured(random, [&](double d) {
    return blade + Smooth(d + width_px) * (band - blade) + Smooth(d) * (ground - band);
  });
  return JudgeIn(bgr, width_px);
}

// A grey ground's light, as a share of its usual light less one.
using Pattern = std::function<double(const Vector2d&)>;

double Stripes(const Vector2d& at) {
  constexpr double kPeriodPx = 45, kAngle = 1.7;
  const double across = Vector2d(std::cos(kAngle), std::sin(kAngle)).dot(at);
  return 0.25 * std::sin(2 * std::numbers::pi * across / kPeriodPx);
}

// Of each 4 x 4 px by itself.
double Grain(const Vector2d& at) {
  constexpr int kPx = 4;
  const int cell = static_cast<int>(at.y()) / kPx * kPatternSide + static_cast<int>(at.x()) / kPx;
  return 0.25 * std::sin(37.0 * cell * cell);
}

// Of a band half as bright as the ground, with a share of its pattern's contrast.
DarkBand JudgeOn(const Pattern& pattern, double share, const std::vector<Vector2d>& other_px = {}) {
  constexpr double kWidthPx = 9, kSteel = 40, kGround = 150, kBand = 75;
  Gaussian random(5);
  const cv::Mat bgr = Patterned(random, [&](double d, const Vector2d& at) -> Vector3d {
    const double ground = kGround * (1 + pattern(at)), band = kBand * (1 + share * pattern(at));
    return Vector3d::Constant(kSteel + Smooth(d + kWidthPx) * (band - kSteel) +
                              Smooth(d) * (ground - band));
  });
  return JudgeIn(bgr, kWidthPx, other_px);
}

TEST(JudgeDarkBand, TellsShadowFromBevelByColour) {
  const Vector3d steel(170, 165, 160), wood(60, 110, 190), brass(90, 150, 200);
  EXPECT_EQ(Judge(steel, 0.3 * wood, wood), DarkBand::kShadow);
  EXPECT_EQ(Judge(steel, 0.3 * steel, wood), DarkBand::kMetal);
  EXPECT_EQ(Judge(brass, 0.2 * brass, steel), DarkBand::kMetal);
  const Vector3d skylight(8, 5, 2);  // shadows are a little bluer than the ground in the sun
  EXPECT_EQ(Judge(steel, 0.3 * wood + skylight, wood), DarkBand::kShadow);
}

// The blade's colour bleeds over a narrow band, whatever that is.
TEST(JudgeDarkBand, TakesNoNarrowBandOfTheBladesColourForMetal) {
  constexpr double kNarrowPx = 4;
  const Vector3d steel(170, 165, 160), brass(90, 150, 200), wood(60, 110, 190);
  EXPECT_EQ(Judge(steel, 0.3 * steel, wood, kNarrowPx), DarkBand::kUnknown);
  EXPECT_EQ(Judge(steel, 0.3 * wood, wood, kNarrowPx), DarkBand::kShadow);
  const Vector3d bluer = steel + 0.4 * (steel - 0.8 * wood);
  EXPECT_EQ(Judge(steel, 0.3 * bluer, wood, kNarrowPx), DarkBand::kMetal);
}

// Skylight and colours that bleed shift what is seen by as much as these two differ.
TEST(JudgeDarkBand, IsSurerWhereColoursDifferMore) {
  const Vector3d steel(170, 168, 166), grey_cloth(140, 120, 126), violet_cloth(160, 100, 120);
  const auto between = [&](const Vector3d& cloth, double share) -> Vector3d {
    return 0.4 * (cloth + share * (steel - cloth));
  };
  EXPECT_EQ(Judge(steel, between(grey_cloth, 0.62), grey_cloth), DarkBand::kUnknown);
  EXPECT_EQ(Judge(steel, between(grey_cloth, 0.38), grey_cloth), DarkBand::kUnknown);
  EXPECT_EQ(Judge(steel, between(violet_cloth, 0.75), violet_cloth), DarkBand::kMetal);
  EXPECT_EQ(Judge(steel, between(violet_cloth, 0.25), violet_cloth), DarkBand::kShadow);
}

TEST(JudgeDarkBand, LeavesGreyOnGreyOpen) {
  const Vector3d steel(170, 168, 166), paper(220, 220, 216);
  EXPECT_EQ(Judge(steel, 0.3 * paper, paper), DarkBand::kUnknown);
}

// A narrow band beside a bevel that is 6 px wide.
bool IsGround(const Vector3d& bevel, const Vector3d& band, double bevel_px = 6) {
  constexpr double kBandPx = 4;
  const Vector3d flat(220, 220, 216), mat(103, 123, 67);
  Gaussian random(4);
  const cv::Mat bgr = Coloured(random, [&](double d) {
    return flat + Smooth(d + kBandPx + bevel_px) * (bevel - flat) +
           Smooth(d + kBandPx) * (band - bevel) + Smooth(d) * (mat - band);
  });
  LocatedEdge edge = OutsideABand();
  edge.rival_px = -kBandPx - bevel_px;
  return IsGroundBesideBevel(bgr, testing::GammaCurve(1), edge, kBandPx);
}

TEST(IsGroundBesideBevel, NeedsTheGroundsColourAndABevelOfAnother) {
  const Vector3d steel(82, 82, 80), mat(103, 123, 67);
  EXPECT_TRUE(IsGround(steel, 0.3 * mat));
  EXPECT_FALSE(IsGround(steel, 0.3 * steel)) << "its dark facet";
  EXPECT_FALSE(IsGround(0.6 * mat, 0.3 * mat)) << "the bevel mirrors the ground";
  EXPECT_FALSE(IsGround(steel, 0.3 * mat, 3)) << "too narrow to have a colour";
}

TEST(JudgeDarkBand, TellsShadowFromBevelByThePatternOfAGreyGround) {
  EXPECT_EQ(JudgeOn(Stripes, 1), DarkBand::kShadow);
  EXPECT_EQ(JudgeOn(Stripes, 0), DarkBand::kMetal);
}

TEST(JudgeDarkBand, AsksNoPatternWhereTheOtherBladeIsNear) {
  constexpr double kGapPx = 15;
  std::vector<Vector2d> other_px;
  for (const LocatedEdgePoint& p : OutsideABand().points)
    other_px.emplace_back(p.trend_px + kGapPx * kNormal);
  EXPECT_EQ(JudgeOn(Stripes, 0, other_px), DarkBand::kUnknown);
}

TEST(JudgeDarkBand, LeavesOpenWhatMayMirrorThePattern) {
  EXPECT_EQ(JudgeOn(Stripes, 0.5), DarkBand::kUnknown);
}

TEST(JudgeDarkBand, AsksNoPatternThatDoesNotGoOnAcrossTheBand) {
  EXPECT_EQ(JudgeOn(Grain, 0), DarkBand::kUnknown);
  EXPECT_EQ(JudgeOn(Grain, 1), DarkBand::kUnknown);
}

// Of the edge of OutsideABand.
std::optional<ColourBorder> BorderIn(const cv::Mat& bgr,
                                     double blade_px = 60,
                                     double told_apart = kToldApart) {
  constexpr double kGapPx = 60;
  LocatedEdge other = OutsideABand();
  for (LocatedEdgePoint& p : other.points) p.trend_px += kGapPx * kNormal;
  return FindColourBorder(
      {bgr, 1}, testing::GammaCurve(1), OutsideABand(), other, blade_px, told_apart);
}

// In light that depends on the distance from the edge.
std::optional<ColourBorder> BorderBeside(const std::function<Vector3d(double)>& light,
                                         double blade_px = 60,
                                         double told_apart = kToldApart) {
  Gaussian random(4);
  return BorderIn(Coloured(random, light), blade_px, told_apart);
}

double MeanOffset(const std::vector<Vector2d>& path_px) {
  double sum = 0;
  for (const Vector2d& p : path_px) sum += kNormal.dot(p) - kOffset;
  return sum / static_cast<double>(path_px.size());
}

constexpr double kBandPx = 9;

TEST(ColourBorder, LiesWhereTheGroundsColourEndsNotWhereItsShadowDoes) {
  const Vector3d steel(90, 86, 82), wood(60, 110, 190);
  for (const double shade : {0.6, 0.3}) {
    const auto border = BorderBeside([&](double d) {
      return steel + Smooth(d + kBandPx) * (shade * wood - steel) + Smooth(d) * (1 - shade) * wood;
    });
    ASSERT_TRUE(border) << shade;
    EXPECT_NEAR(MeanOffset(border->path_px), -kBandPx, 1) << shade;
    EXPECT_NEAR(border->offset_px, -kBandPx, 1.5) << shade;
  }
}

TEST(ColourBorder, LiesWhereTheBladesColourEndsNotWhereItsBevelDoes) {
  const Vector3d steel(170, 165, 160), drape(150, 90, 40);
  for (const double bevel : {0.6, 0.3}) {
    const auto border = BorderBeside([&](double d) {
      return steel + Smooth(d) * (bevel - 1) * steel +
             Smooth(d - kBandPx) * (drape - bevel * steel);
    });
    ASSERT_TRUE(border) << bevel;
    EXPECT_NEAR(MeanOffset(border->path_px), kBandPx, 1) << bevel;
    EXPECT_NEAR(border->offset_px, kBandPx, 1.5) << bevel;
  }
}

// A shadow narrows along the edge; what compression smears ends with its blocks.
TEST(ColourBorder, IsNoneWhereColourEndsWithABlock) {
  constexpr double kHalfPx = 8;
  const Vector3d steel(90, 86, 82), wood(60, 110, 190), smeared = 1.3 * steel;
  const Vector2d along(-kNormal.y(), kNormal.x());
  const auto border_with = [&](const std::function<double(double)>& width_px) {
    Gaussian random(4);
    return BorderIn(Patterned(random, [&](double d, const Vector2d& place) -> Vector3d {
      return steel + Smooth(d) * (smeared - steel) +
             Smooth(d - width_px(along.dot(place) - 40)) * (wood - smeared);
    }));
  };
  const auto narrowing = border_with([](double at_px) { return kHalfPx * (1 - at_px / 70); });
  ASSERT_TRUE(narrowing);
  EXPECT_NEAR(MeanOffset(narrowing->path_px), kHalfPx, 1);
  EXPECT_FALSE(border_with([](double at_px) { return at_px < 0 ? 2 * kHalfPx : 0; }));
}

// Grey shows the border of a bevel as dark as the ground for the blade's: what is then left of the
// blade is narrow, and the bevel all that lies near.
TEST(ColourBorder, LiesBeyondABevelThatPassesForGround) {
  constexpr double kWidePx = 22, kBladePx = 20;
  const Vector3d steel(170, 165, 160), drape(90, 54, 24);
  const auto border = BorderBeside(
      [&](double d) {
        return steel + Smooth(d) * -0.6 * steel + Smooth(d - kWidePx) * (drape - 0.4 * steel);
      },
      kBladePx);
  ASSERT_TRUE(border);
  EXPECT_NEAR(MeanOffset(border->path_px), kWidePx, 1);
  EXPECT_NEAR(border->offset_px, kWidePx, 1.5);
}

// All that lies near passes for ground, being unlike the blade; the ground is more so.
TEST(ColourBorder, LiesBeyondABevelThatMirrorsSomeOfTheGround) {
  constexpr double kWidePx = 22, kMirrorsPx = 14, kBladePx = 20;
  const Vector3d steel(170, 165, 160), drape(90, 54, 24);
  const Vector3d dark = 0.1 * steel + 0.08 * drape, mirror = 0.1 * steel + 0.8 * drape;
  const auto border = BorderBeside(
      [&](double d) -> Vector3d {
        return steel + Smooth(d) * (mirror - steel) + Smooth(d - kMirrorsPx) * (dark - mirror) +
               Smooth(d - kWidePx) * (drape - dark);
      },
      kBladePx);
  ASSERT_TRUE(border);
  EXPECT_NEAR(MeanOffset(border->path_px), kWidePx, 1);
  EXPECT_NEAR(border->offset_px, kWidePx, 1.5);
}

// The edge was followed along the bevel's border first and then along its own.
TEST(ColourBorder, MayBeFollowedFromAnEdgeThatLeavesIt) {
  const Vector3d steel(170, 165, 160), drape(90, 54, 24);
  constexpr double kBladePx = 60, kGapPx = 60;
  Gaussian random(4);
  const cv::Mat bgr =
      Coloured(random, [&](double d) { return steel + Smooth(d) * (drape - steel); });
  LocatedEdge edge = OutsideABand(), other = edge;
  for (LocatedEdgePoint& p : other.points) p.trend_px += kGapPx * kNormal;
  for (std::size_t i = 0; i < edge.points.size(); ++i) {
    const double early = 1 - static_cast<double>(i) / static_cast<double>(edge.points.size());
    const double wave = std::sin(std::numbers::pi / 2 * static_cast<double>(i) / 10);
    edge.points[i].trend_px -= (12 * early + 2 * wave) * kNormal;
  }
  const auto border = FindColourBorder({bgr, 1}, testing::GammaCurve(1), edge, other, kBladePx);
  ASSERT_TRUE(border);
  EXPECT_NEAR(MeanOffset(border->path_px), 0, 1);
}

TEST(ColourBorder, LeavesTheEdgeWhereColourAndLightChangeTogether) {
  const Vector3d steel(170, 165, 160), wood(60, 110, 190);
  for (const double shade : {1.0, 0.5, 0.1}) {
    const auto border =
        BorderBeside([&](double d) { return shade * (steel + Smooth(d) * (wood - steel)); });
    ASSERT_TRUE(border) << shade;
    EXPECT_NEAR(border->offset_px, 0, 0.5) << shade;
  }
}

// The bevel mirrors the wood as bright as it is; before it the wood lies in the blade's own shadow.
TEST(ColourBorder, IsNoneWhereABevelMirrorsTheGround) {
  constexpr double kShadowPx = 4;
  const Vector3d steel(170, 165, 160), wood(60, 110, 190);
  EXPECT_FALSE(BorderBeside([&](double d) {
    const double shade = 1 - 0.6 * Smooth(d) * (1 - Smooth(d - kShadowPx));
    return steel + Smooth(d + kBandPx) * (shade * wood - steel);
  }));
}

// A thread of the cloth was followed: the ground's colour goes on within it as bright as before,
// but over more than any bevel's width.
TEST(ColourBorder, LiesFarWithinALineOfThePlainGround) {
  constexpr double kFarPx = 25;
  const Vector3d steel(90, 86, 82), drape(170, 90, 40);
  const auto light = [&](double d) { return steel + Smooth(d + kFarPx) * (drape - steel); };
  const auto border = BorderBeside(light);
  ASSERT_TRUE(border);
  EXPECT_NEAR(border->offset_px, -kFarPx, 1.5);
  EXPECT_FALSE(BorderBeside(light, 90)) << "a wide bevel may mirror the ground";
}

// A blade of a faint blue with a grey bevel: white has no colour, nor what was cut off there.
TEST(ColourBorder, IsNotToldFromPlainWhiteByAFaintColour) {
  constexpr double kFaint = 0.05;
  const Vector3d steel(120, 109, 109);
  const auto border_before = [&](double ground) {
    const Vector3d white(ground, ground, ground);
    return BorderBeside(
        [&](double d) {
          return steel + Smooth(d + kBandPx) * (0.8 * white - steel) + Smooth(d) * 0.2 * white;
        },
        60,
        kFaint);
  };
  EXPECT_TRUE(border_before(225));
  EXPECT_FALSE(border_before(255));
}

TEST(ColourBorder, IsNotSeenOnAGreyGroundNorWhereTheBladeMirrorsTheGround) {
  const Vector3d steel(170, 165, 160), paper(230, 228, 226), wood(60, 110, 190);
  EXPECT_FALSE(BorderBeside([&](double d) { return steel + Smooth(d) * (paper - steel); }));
  constexpr double kMirroredPx = 14;
  EXPECT_FALSE(BorderBeside([&](double d) {
    return steel + Smooth(d / kMirroredPx * 2) * (0.6 * wood - steel) + Smooth(d) * 0.4 * wood;
  }));
}

}  // namespace
}  // namespace bladecurve
