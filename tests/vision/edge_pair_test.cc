// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// What both edges together say of the dark bands beside them.
#include "vision/edge_pair.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::FarFrom;
using testing::kUpperOnLeft;
using testing::Measured;
using testing::SceneWithShadow;

constexpr double kDegree = std::numbers::pi / 180;

// Wide open in low sun from behind the rings: both blades throw their shadows into the gap.
SceneSpec SceneWithShadowsInTheGap(double elevation_rad) {
  SceneSpec spec;
  spec.width = 1600;
  spec.height = 1200;
  spec.theta_rad = 75 * kDegree;
  spec.heading_rad = 0;
  spec.scissors.upper_on_top = false;
  spec.scissors.bevel_mm = 0;
  spec.light.direction_rad = std::numbers::pi;
  spec.light.elevation_rad = elevation_rad;
  spec.light.shadow = 0.9;
  spec.light.shadow_blur_mm = 0.15;
  spec.light.glint = 0;
  return spec;
}

TEST(LocateBlades, TakesDarkBandsAlongBothBladesForShadows) {
  constexpr double kClosePx = 0.3;
  for (const double elevation_rad : {45 * kDegree, 35 * kDegree}) {
    const SceneSpec spec = SceneWithShadowsInTheGap(elevation_rad);
    const Photo photo = Measured::PhotoOf(RenderScene(spec).bgr);
    ScaleOptions options;
    options.mm_per_px = spec.camera.mm_per_px;
    const ScaleResult scale = FindScale(photo, options);
    StageLog log;
    const Scene scene = FindScene(photo, scale.markers, {}, &log);
    const BladeEdges edges = LocateBlades(photo, scale, scene, kUpperOnLeft);
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << elevation_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << elevation_rad;
  }
}

// A soft shadow that begins at the edge looks like blur on both sides where the edge is faint.
TEST(LocateBlades, TakesNoShadowForBlurThatPrintAndTheOtherBladeDoNotShow) {
  constexpr double kSofter = 1.1;   // times the print's blur
  constexpr double kClosePx = 1.1;  // 1.3 to 1.5 if the shadow is taken for blur
  for (const auto& [elevation_rad, direction_rad] :
       {std::pair(62 * kDegree, 315 * kDegree), std::pair(72 * kDegree, 270 * kDegree)}) {
    const Measured measured(SceneWithShadow(elevation_rad, direction_rad, 0.8));
    const LocatedEdge& lower = measured.blades.lower.edge;
    EXPECT_LT(lower.blur_px, kSofter * measured.scale.markers[0].blur_px) << elevation_rad;
    EXPECT_LT(FarFrom(measured.truth.lower, lower.points), kClosePx) << elevation_rad;
  }
}

// Print tells that light rises too slowly there for a blade's border.
TEST(LocateBlades, GoesFromASoftShadowsBorderToWhereTheShadowBegins) {
  constexpr double kClosePx = 0.3;  // the shadow's border lies 1.3 to 1.9 px off
  for (const auto& [elevation_rad, direction_rad] :
       {std::pair(62 * kDegree, 315 * kDegree), std::pair(72 * kDegree, 270 * kDegree)}) {
    const Measured measured(SceneWithShadow(elevation_rad, direction_rad, 0.4));
    EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.edge.points), kClosePx)
        << elevation_rad;
  }
}

}  // namespace
}  // namespace bladecurve
