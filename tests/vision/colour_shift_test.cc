// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/colour_shift.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::Measured;
using testing::SceneWithMarkers;

SceneSpec Plain(Backdrop backdrop) {
  SceneSpec spec = SceneWithMarkers();
  spec.backdrop = backdrop;
  spec.drape_rgb = {0.02, 0.25, 0.12};
  spec.camera.blur_px = 1.5;
  spec.light.shadow = 0;
  spec.light.glint = 0;
  return spec;
}

// How far out of the blade the edge lies, mean.
double OffPx(const Measured& measured, bool upper) {
  const std::vector<Eigen::Vector2d>& truth = measured.TrueEdge(upper).px;
  double sum = 0, count = 0;
  for (const LocatedEdgePoint& p :
       upper ? measured.blades.upper.edge.points : measured.blades.lower.edge.points) {
    if (!p.inlier) continue;
    const auto nearest = std::min_element(truth.begin(), truth.end(), [&](auto& a, auto& b) {
      return (a - p.trend_px).squaredNorm() < (b - p.trend_px).squaredNorm();
    });
    sum += p.normal.dot(p.trend_px - *nearest);
    ++count;
  }
  return sum / count;
}

TEST(UndoLumaShift, PutsEdgesOnColouredGroundWhereTheyAre) {
  constexpr double kShifted = 0.1, kLeft = 0.5, kDoubt = 0.02;
  Measured measured{Plain(Backdrop::kDrape)};
  for (const bool upper : {true, false}) {
    const double before_px = OffPx(measured, upper);
    EXPECT_GT(before_px, kShifted) << upper;
    Blades blades = measured.blades;
    UndoLumaShift(measured.View(), Plan::kAsNeeded, &measured.blades);
    EXPECT_LT(std::abs(OffPx(measured, upper)), kLeft * before_px) << upper;
    EXPECT_GT(measured.Blade(upper).edge.common_sigma_px, kDoubt) << upper;
    measured.blades = blades;
  }
}

TEST(UndoLumaShift, MovesNothingOnPaper) {
  constexpr double kNothing = 0.01;
  Measured measured{Plain(Backdrop::kPaper)};
  const double before_px = OffPx(measured, true);
  UndoLumaShift(measured.View(), Plan::kAsNeeded, &measured.blades);
  EXPECT_NEAR(OffPx(measured, true), before_px, kNothing);
}

// A narrow bevel that mirrors something dark: the blade's colours are read beyond it, and the
// ground is not brighter beside it than further off.
TEST(UndoLumaShift, MovesNothingBesideADarkBandOfGreyMetal) {
  constexpr double kNothing = 0.01, kDarker = 0.4;  // px; of white
  Measured measured{Plain(Backdrop::kPaper)};
  for (LocatedEdgePoint& p : measured.blades.upper.edge.points) p.contrast += kDarker;
  const double before_px = OffPx(measured, true);
  UndoLumaShift(measured.View(), Plan::kAsNeeded, &measured.blades);
  EXPECT_NEAR(OffPx(measured, true), before_px, kNothing);
}

TEST(UndoLumaShift, MovesNoEdgeThatWasLocatedInColours) {
  Measured measured{Plain(Backdrop::kDrape)};
  measured.blades.upper.edge.unbound_blur_px = std::numeric_limits<double>::quiet_NaN();
  const double before_px = OffPx(measured, true);
  UndoLumaShift(measured.View(), Plan::kAsNeeded, &measured.blades);
  EXPECT_EQ(OffPx(measured, true), before_px);
}

// Whose colours take as long to decode as all the rest.
TEST(UndoLumaShift, OnlyDoubtsInLargePicturesUnlessAllIsWanted) {
  constexpr double kFiner = 2.5, kDoubt = 0.1;
  SceneSpec spec = Plain(Backdrop::kDrape);
  spec.camera.mm_per_px /= kFiner;
  spec.width = static_cast<int>(spec.width * kFiner);
  spec.height = static_cast<int>(spec.height * kFiner);
  Measured measured{spec};
  const double before_px = OffPx(measured, true);
  Blades blades = measured.blades;
  UndoLumaShift(measured.View(), Plan::kAsNeeded, &measured.blades);
  EXPECT_EQ(OffPx(measured, true), before_px);
  EXPECT_GT(measured.blades.upper.edge.common_sigma_px,
            kDoubt * measured.blades.upper.edge.blur_px);
  measured.blades = blades;
  UndoLumaShift(measured.View(), Plan::kFull, &measured.blades);
  EXPECT_LT(std::abs(OffPx(measured, true)), std::abs(before_px));
}

}  // namespace
}  // namespace bladecurve
