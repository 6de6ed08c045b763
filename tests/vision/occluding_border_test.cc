// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/occluding_border.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::BrightenedAlongUpperEdge;
using testing::Grained;
using testing::kBevelPx;
using testing::Measured;
using testing::SceneWithMarkers;
using testing::WithMirroringBevel;

// Whether, in `picture`, the upper blade's border is taken to be where the line lies that so far
// outwards of its true edge runs, the edge having been found so far inwards of that.
bool Occludes(const cv::Mat& picture, double border_px, double inwards_px = kBevelPx) {
  Measured measured{SceneWithMarkers()};
  LocatedBlade& upper = measured.blades.upper;
  measured.Misplace(&upper, border_px);
  const std::vector<LocatedEdgePoint> border = upper.used;
  measured.Misplace(&upper, -inwards_px);
  measured.photo = Measured::PhotoOf(picture);
  return IsOccludingBorder(measured.View(), border, upper, measured.blades.lower);
}

// Beside the upper edge, from so far within the blade to so far; grey levels brighter.
cv::Mat WithBand(double from_px, double to_px, double brighter) {
  return Grained(BrightenedAlongUpperEdge(
      SceneWithMarkers(), from_px, to_px, [&](double, double) { return brighter; }));
}

TEST(IsOccludingBorder, IsWhereABevelHidesTheOtherBlade) {
  EXPECT_TRUE(Occludes(WithMirroringBevel(SceneWithMarkers()), 0));
}

// Of the same bevel, what lies further in or out is no border.
TEST(IsOccludingBorder, IsNotWhereTheOtherBladesEdgeGoesOnOrEndsBefore) {
  constexpr double kAsidePx = 7;
  const cv::Mat picture = WithMirroringBevel(SceneWithMarkers());
  EXPECT_FALSE(Occludes(picture, kAsidePx));
  EXPECT_FALSE(Occludes(picture, -kAsidePx, kBevelPx - kAsidePx));
}

// The other blade's edge is seen in it.
TEST(IsOccludingBorder, IsNotAShadowsBorder) {
  EXPECT_FALSE(Occludes(WithBand(-kBevelPx, 0, -60), kBevelPx));
}

}  // namespace
}  // namespace bladecurve
