// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "measured_blades.h"

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
  const EdgePair edges{PointsOf(measured.blades.upper), PointsOf(measured.blades.lower)};
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

}  // namespace
}  // namespace bladecurve
