// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/mirrored_trace.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::FarFrom;
using testing::kBevelPx;
using testing::Measured;
using testing::SceneWithMarkers;
using testing::WithMirroringBevel;

// In `picture` of the scene, the upper edge having been taken for the bevel's inner border.
struct Found {
  bool any = false;
  double off_px = 0;
};

Found FindIn(const SceneSpec& spec, const cv::Mat& picture) {
  Measured measured{spec};
  measured.Misplace(&measured.blades.upper, -kBevelPx);
  measured.photo = Measured::PhotoOf(picture);
  const LocatedBlade& lower = measured.blades.lower;
  const auto trace =
      FindMirroredTrace(measured.View(),
                        measured.blades.upper,
                        lower,
                        LineBetween(measured.View(), measured.pivot, measured.blades),
                        kBevelPx);
  if (!trace) return {};
  std::vector<LocatedEdgePoint> points = lower.used;
  for (LocatedEdgePoint& p : points) p = trace->line.Reflected(p);
  return {true, FarFrom(measured.truth.upper, points)};
}

TEST(FindMirroredTrace, FindsTheBorderOfABevelThatMirrorsTheGround) {
  constexpr double kClosePx = 0.4;
  const SceneSpec spec = SceneWithMarkers();
  const Found found = FindIn(spec, WithMirroringBevel(spec));
  EXPECT_TRUE(found.any);
  EXPECT_LT(found.off_px, kClosePx);
}

TEST(FindMirroredTrace, FindsNoneOnABareSheet) {
  SceneSpec bare = SceneWithMarkers();
  bare.with_scissors = false;
  EXPECT_FALSE(FindIn(SceneWithMarkers(), RenderScene(bare).bgr).any);
}

}  // namespace
}  // namespace bladecurve
