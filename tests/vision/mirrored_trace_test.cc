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
using testing::Measured;
using testing::SceneWithMarkers;

constexpr double kBevelPx = 9;

// The scissors with a bevel on the upper blade that mirrors the sheet but for a few grey levels,
// brighter here and darker there, in a grainy picture.
cv::Mat WithMirroringBevel(const SceneSpec& spec) {
  constexpr double kStepPx = 0.25, kUnlike = 3, kWaves = 1.5, kGrain = 4, kBeyondPx = 3;
  const cv::Mat picture = RenderScene(spec).bgr;
  cv::Mat retouched = picture.clone();
  const std::vector<Vector2d>& edge = TruthOf(spec).upper.px;
  for (std::size_t i = 1; i < edge.size(); ++i) {
    const Vector2d along = edge[i] - edge[i - 1];
    const Vector2d outwards = Vector2d(-along.y(), along.x()).normalized();  // the tips lie right
    for (double t = 0; t < 1; t += kStepPx / along.norm()) {
      const Vector2d on_edge = edge[i - 1] + t * along;
      for (double depth = 0; depth < kBevelPx; depth += kStepPx) {
        const auto pixel = [](const Vector2d& at) {
          return cv::Point(static_cast<int>(std::lround(at.x())),
                           static_cast<int>(std::lround(at.y())));
        };
        const cv::Vec3b sheet =
            picture.at<cv::Vec3b>(pixel(on_edge + (depth + kBeyondPx) * outwards));
        const double share = static_cast<double>(i) / static_cast<double>(edge.size());
        const double unlike = kUnlike * std::cos(kWaves * 2 * std::numbers::pi * share);
        retouched.at<cv::Vec3b>(pixel(on_edge - depth * outwards)) =
            cv::Vec3b(cv::Vec3d(sheet) + cv::Vec3d::all(std::round(unlike)));
      }
    }
  }
  cv::Mat grain(retouched.size(), CV_16SC3);
  cv::RNG(1).fill(grain, cv::RNG::NORMAL, 0, kGrain);
  cv::add(retouched, grain, retouched, cv::noArray(), CV_8UC3);
  return retouched;
}

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
  for (LocatedEdgePoint& p : points) {
    const Vector2d aside = trace->line.Reflected(p.point_px + p.normal);
    p.point_px = trace->line.Reflected(p.point_px);
    p.normal = (aside - p.point_px).normalized();
  }
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
