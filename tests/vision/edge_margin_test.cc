// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Shadows that were taken for blade, and bevels and rounded flanks, which are blade.
#include "vision/edge/edge_margin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

using testing::Smooth;

constexpr double kEdgeX = 100, kBladePx = 60;
constexpr double kBladeLight = 120, kGroundLight = 200, kDark = 50;  // grey values, linear

// Light that depends on the distance from an upright edge, the ground on its right.
cv::Mat PictureOf(const std::function<double(double)>& light) {
  testing::Gaussian random(1);
  cv::Mat grey(160, 200, CV_8UC1);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x)
      grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(light(x - kEdgeX) + random());
  }
  return grey;
}

LocatedEdge UprightEdge() {
  LocatedEdge edge;
  for (int y = 10; y < 150; ++y) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = {kEdgeX, static_cast<double>(y)};
    point.normal = {1, 0};
    point.contrast = (kGroundLight - kBladeLight) / 255;
    edge.points.push_back(point);
  }
  return edge;
}

std::optional<Margin> MarginIn(const std::function<double(double)>& light) {
  return FindMargin(PictureOf(light), testing::GammaCurve(1), UprightEdge(), kBladePx);
}

double WithMargin(double d, double width_px) {
  return kBladeLight + Smooth(d + width_px) * (kDark - kBladeLight) +
         Smooth(d) * (kGroundLight - kDark);
}

TEST(FindMargin, MeasuresWhatIsDarkerThanBladeAndGround) {
  for (const double width_px : {4, 9, 20}) {
    const auto margin = MarginIn([&](double d) { return WithMargin(d, width_px); });
    ASSERT_TRUE(margin) << width_px;
    EXPECT_NEAR(margin->width_px, width_px, 1.5);
    EXPECT_NEAR(margin->light, kDark / 255, 0.02);
    EXPECT_NEAR(margin->ground, kGroundLight / 255, 0.02);
  }
}

TEST(FindMargin, MeasuresWhatIsBrighterThanABlackBlade) {
  constexpr double kBlack = 20;
  for (const double width_px : {6, 9, 20}) {
    const auto margin = MarginIn([&](double d) {
      return kBlack + Smooth(d + width_px) * (kDark - kBlack) + Smooth(d) * (kGroundLight - kDark);
    });
    ASSERT_TRUE(margin) << width_px;
    EXPECT_EQ(margin->than_blade, Shadow::kBrighter);
    EXPECT_NEAR(margin->width_px, width_px, 1.5);
    EXPECT_NEAR(margin->light, kDark / 255, 0.02);
  }
  EXPECT_FALSE(MarginIn([](double d) {
    return kBlack + std::exp(d / 12) * (kDark - kBlack) + Smooth(d) * (kGroundLight - kDark);
  })) << "shading";
}

TEST(FindMargin, SeesNoneWhereThereIsNone) {
  EXPECT_FALSE(
      MarginIn([](double d) { return kBladeLight + Smooth(d) * (kGroundLight - kBladeLight); }));
  EXPECT_FALSE(MarginIn([](double d) { return WithMargin(d, 0.8 * kBladePx); })) << "all is dark";
  EXPECT_FALSE(MarginIn([](double d) {
    return kGroundLight + Smooth(d) * (kBladeLight - kGroundLight);
  })) << "a bright blade";
}

std::optional<Margin> LineIn(const std::function<double(double)>& light) {
  return FindDarkLine(PictureOf(light), testing::GammaCurve(1), UprightEdge(), kBladePx);
}

TEST(FindDarkLine, MeasuresWhatIsAsNarrowAsBlur) {
  for (const double width_px : {1.5, 2.0, 2.75}) {
    const auto line = LineIn([&](double d) { return WithMargin(d, width_px); });
    ASSERT_TRUE(line) << width_px;
    EXPECT_NEAR(line->width_px, width_px, 0.8);
  }
}

TEST(FindDarkLine, SeesNoneWhereThereIsNone) {
  EXPECT_FALSE(LineIn([](double d) { return WithMargin(d, 0); }));
  EXPECT_FALSE(LineIn([](double d) { return WithMargin(d, 6); })) << "a margin";
  EXPECT_FALSE(LineIn([](double d) {
    return kDark + (1 - std::exp(d / 4)) * (kBladeLight - kDark) +
           Smooth(d) * (kGroundLight - kDark);
  })) << "shading";
}

TEST(EndsSharply, TellsShadowsFromShading) {
  constexpr double kWidthPx = 12;
  const auto ends_sharply = [](const std::function<double(double)>& light) {
    const cv::Mat grey = PictureOf(light);
    const ToneCurve tone = testing::GammaCurve(1);
    const auto margin = FindMargin(grey, tone, UprightEdge(), kBladePx);
    EXPECT_TRUE(margin);
    return margin && EndsSharply(grey, tone, UprightEdge(), *margin);
  };
  EXPECT_TRUE(ends_sharply([](double d) { return WithMargin(d, kWidthPx); }));
  EXPECT_FALSE(ends_sharply([](double d) {
    return kDark + (1 - std::exp(d / kWidthPx)) * (kBladeLight - kDark) +
           Smooth(d) * (kGroundLight - kDark);
  })) << "shading";
}

TEST(BandBeside, LiesBetweenAnEdgeAndALineWithin) {
  const LocatedEdge edge = UprightEdge();
  const cv::Mat grey = PictureOf([](double d) { return WithMargin(d, 12); });
  const auto band = BandBeside(grey, testing::GammaCurve(1), edge, -12);
  ASSERT_TRUE(band);
  EXPECT_EQ(band->width_px, 12);
  EXPECT_NEAR(band->light, kDark / 255, 0.02);
  EXPECT_FALSE(BandBeside(grey, testing::GammaCurve(1), edge, 1000)) << "out of the picture";
}

// Cut off at black, light says nothing of what is darker.
TEST(MayLieAlong, TakesOneBlackForAnother) {
  const cv::Mat grey = PictureOf([](double d) { return Smooth(d) * kGroundLight; });
  EXPECT_TRUE(MayLieAlong(grey, testing::GammaCurve(1), UprightEdge(), {20, 0}));
}

TEST(MayLieAlong, SeesStripsAsDarkAndAThirdAsWideOnEitherSide) {
  constexpr double kBandPx = 20;
  const auto lies_along = [](const std::function<double(double)>& light) {
    return MayLieAlong(
        PictureOf(light), testing::GammaCurve(1), UprightEdge(), {kBandPx, kDark / 255});
  };
  const auto with_margin = [&](double width_px, double shift_px) {
    return lies_along([=](double d) { return WithMargin(d + shift_px, width_px); });
  };
  EXPECT_FALSE(with_margin(0, 0));
  EXPECT_FALSE(with_margin(3, 0)) << "contact with the ground darkens that much";
  EXPECT_TRUE(with_margin(8, 0));
  EXPECT_TRUE(with_margin(8, -8)) << "outside the edge";
  EXPECT_FALSE(lies_along([](double d) { return 20 + Smooth(d) * (kGroundLight - 20); }))
      << "a black blade is darker than the band";
}

TEST(AreOneShading, NeedsMarginsDarkerThanTheBladeAndAboutAsDarkAndWide) {
  const Margin flank{10, 0.2, 0.7};
  EXPECT_TRUE(AreOneShading(flank, {7, 0.28, 0.6}));
  EXPECT_FALSE(AreOneShading(flank, {4, 0.2, 0.7}));
  EXPECT_FALSE(AreOneShading(flank, {10, 0.4, 0.7}));
  EXPECT_FALSE(AreOneShading(flank, {10, 0.2, 0.5}));
  EXPECT_FALSE(AreOneShading(flank, {10, 0.2, 0.7, Shadow::kBrighter}));
}

TEST(AreOneShadow, NeedsTheSameLightGroundAndAboutTheSameWidth) {
  const Margin shadow{10, 0.2, 0.7};
  EXPECT_TRUE(AreOneShadow(shadow, {7, 0.19, 0.72}));
  EXPECT_FALSE(AreOneShadow(shadow, {7, 0.17, 0.72}));
  EXPECT_FALSE(AreOneShadow({10, 0.17, 0.7}, {7, 0.2, 0.72}));
  EXPECT_FALSE(AreOneShadow(shadow, {7, 0.19, 0.64}));
  EXPECT_FALSE(AreOneShadow(shadow, {4, 0.2, 0.7}));
  EXPECT_FALSE(AreOneShadow({4, 0.2, 0.7}, shadow));
  EXPECT_FALSE(AreOneShadow(shadow, {10, 0.2, 0.7, Shadow::kBrighter}));
}

TEST(AreAsDark, ComparesMarginsWithTheirGrounds) {
  const Margin shadow{10, 0.05, 0.7};
  EXPECT_TRUE(AreAsDark(shadow, {3, 0.1, 0.75})) << "narrow: blur adds light of the ground";
  EXPECT_FALSE(AreAsDark(shadow, {10, 0.15, 0.7}));
}

TEST(ShadowBesidePx, MeasuresWhatIsMuchDarkerThanBesideTheOtherEdgeAndEnds) {
  constexpr double kShadowPx = 12, kWidestPx = 30;
  const auto shadow_in = [](double width_px, double shade, double widest_px) {
    const cv::Mat grey = PictureOf([&](double d) {
      return kBladeLight + Smooth(d) * (shade * kGroundLight - kBladeLight) +
             Smooth(d - width_px) * (1 - shade) * kGroundLight;
    });
    LocatedEdge other = UprightEdge();
    for (LocatedEdgePoint& point : other.points) point.trend_px.x() += 50;
    return ShadowBesidePx(grey, testing::GammaCurve(1), UprightEdge(), other, widest_px);
  };
  const auto shadow = shadow_in(kShadowPx, 0.5, kWidestPx);
  ASSERT_TRUE(shadow);
  EXPECT_NEAR(*shadow, kShadowPx, 1.5);
  EXPECT_FALSE(shadow_in(kShadowPx, 0.8, kWidestPx)) << "no darker than folds";
  EXPECT_FALSE(shadow_in(kShadowPx, 0.5, kShadowPx - 4)) << "another ground";
  EXPECT_FALSE(shadow_in(300, 0.5, 200)) << "out of the picture";
}

// A bright blade on dark ground, bordered by a bevel that mirrors it.
double WithDimBevel(double d, double width_px) {
  constexpr double kBright = 220, kBevel = 70, kDarkGround = 30;
  return kBright + Smooth(d) * (kBevel - kBright) + Smooth(d - width_px) * (kDarkGround - kBevel);
}

TEST(TrailPx, TellsADimBevelFromNoneAndFromAShadow) {
  const auto trail_in = [](const std::function<double(double)>& light) {
    return TrailPx(PictureOf(light), testing::GammaCurve(1), UprightEdge());
  };
  const auto none = trail_in([](double d) { return WithDimBevel(d, 0); });
  ASSERT_TRUE(none);
  EXPECT_LT(*none, 2);
  for (const double width_px : {2.0, 4.0}) {
    const auto trail = trail_in([&](double d) { return WithDimBevel(d, width_px); });
    ASSERT_TRUE(trail) << width_px;
    EXPECT_LT(*trail - *none, width_px + 0.3);
    EXPECT_GT(*trail - *none, width_px - 1.1) << "the border's own step is less than the whole";
  }
  const auto shadow = trail_in([](double d) { return WithDimBevel(d, 0) + Smooth(d - 5) * 40; });
  ASSERT_TRUE(shadow);
  EXPECT_NEAR(*shadow, *none, 0.6);
  EXPECT_FALSE(trail_in([](double d) {
    return kBladeLight + Smooth(d) * (kGroundLight - kBladeLight);
  })) << "a bright ground";
}

TEST(LocateEdgeBeyond, FindsTheBorderOfABevelThatMakesNoStepOfItsOwn) {
  for (const double width_px : {2.0, 3.0}) {
    const cv::Mat grey = PictureOf([&](double d) { return WithDimBevel(d, width_px); });
    EdgeOptions options;
    options.blur_px = 0.75;  // with the pixel's box that of Smooth
    const LocatedEdge border = LocateEdgeBeyond(
        UprightEdge(), width_px + 0.4, false, grey, testing::GammaCurve(1), options);
    for (const LocatedEdgePoint& point : border.points) {
      if (point.inlier) {
        EXPECT_NEAR(point.trend_px.x(), kEdgeX + width_px, 0.15) << width_px;
      }
    }
    EXPECT_LT(TypicalContrast(border), 0);
  }
}

}  // namespace
}  // namespace bladecurve
