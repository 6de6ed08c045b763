// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/print_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "vision/tone_scene.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

SeenMarker Told(double exponent, double sigma, double blur_px = 1) {
  SeenMarker marker;
  marker.corners_px.fill(Vector2d::Zero());
  marker.blur_px = blur_px;
  marker.tone = {exponent, sigma};
  return marker;
}

TEST(ToneOfPrint, IsWhatCamerasDoWhereNoMarkerTells) {
  SeenMarker overexposed = Told(1.2, 0.01);
  overexposed.overexposed = true;
  const double known = SrgbToneCurve().exponent_sigma;
  for (const std::vector<SeenMarker>& markers : {std::vector<SeenMarker>{},
                                                 {Told(1, std::numeric_limits<double>::infinity())},
                                                 {overexposed},
                                                 {Told(1.2, 0.01, 0.4)}}) {
    const ToneSeen tone = ToneOfPrint(markers);
    EXPECT_EQ(tone.exponent, 1);
    EXPECT_NEAR(tone.sigma, known, 1e-12);
  }
}

TEST(ToneOfPrint, WeighsMarkersByWhatTheyTell) {
  const ToneSeen clear = ToneOfPrint({Told(1.2, 0.01), Told(1.2, 0.01)}),
                 faint = ToneOfPrint({Told(1.2, 0.2), Told(1.2, 0.2)}),
                 at_odds = ToneOfPrint({Told(1.4, 0.01), Told(1.0, 0.01)});
  EXPECT_GT(clear.exponent, 1.07);
  EXPECT_LT(clear.sigma, 0.8 * SrgbToneCurve().exponent_sigma);
  EXPECT_LT(faint.exponent, 1.05);
  EXPECT_GT(faint.sigma, clear.sigma);
  EXPECT_LT(at_odds.exponent, 0.5 * (1 + clear.exponent));
  EXPECT_GT(at_odds.sigma, clear.sigma);
}

TEST(FindScale, ReadsTheToneCurveOffTheCardsBorders) {
  constexpr double kMostPx = 0.03;  // with a card in view, of gamma 2.2
  for (const double gamma : {1.8, 2.2, 2.6}) {
    const ToneCurve tone = testing::ToneByCard({.srgb = false, .gamma = gamma});
    EXPECT_LT(tone.exponent_sigma, 0.8 * SrgbToneCurve().exponent_sigma) << gamma;
    for (const auto& [blade, ground] : {std::pair(20.0, 200.0), std::pair(200.0, 40.0)}) {
      const testing::EdgeLook look{1, blade, ground, 0.5, gamma};
      const double by_srgb = std::abs(testing::OffsetOfEdge(look, SrgbToneCurve()));
      EXPECT_LT(std::abs(testing::OffsetOfEdge(look, tone)), std::max(0.75 * by_srgb, kMostPx))
          << gamma << ' ' << blade;
    }
  }
}

TEST(FindScale, LeavesPicturesOfSrgbAsTheyAre) {
  const ToneCurve tone = testing::ToneByCard({}), srgb = SrgbToneCurve();
  EXPECT_NEAR(tone.linear[128], srgb.linear[128], 0.03 * srgb.linear[128]);
}

}  // namespace
}  // namespace bladecurve
