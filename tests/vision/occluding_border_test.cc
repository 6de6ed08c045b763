// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/occluding_border.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::BrightenedAlongUpperEdge;
using testing::Grained;
using testing::kBevelPx;
using testing::Measured;
using testing::RetouchedAlongUpperEdge;
using testing::SceneWithMarkers;
using testing::WithMirroringBevel;

// What becomes of the lower blade's edge, in `picture`, up to a line that lies so far outwards of
// the true upper edge, that having been found so far inwards of the line.
Occlusion Seen(const cv::Mat& picture, double border_px, double inwards_px = kBevelPx) {
  Measured measured{SceneWithMarkers()};
  LocatedBlade& upper = measured.blades.upper;
  measured.Misplace(&upper, border_px);
  const std::vector<LocatedEdgePoint> border = upper.used;
  measured.Misplace(&upper, -inwards_px);
  measured.photo = Measured::PhotoOf(picture);
  return OcclusionUpTo(border, measured.View(), upper, measured.blades.lower);
}

TEST(OcclusionUpTo, TellsWhereABevelHidesTheOtherEdge) {
  EXPECT_EQ(Seen(WithMirroringBevel(SceneWithMarkers()), 0), Occlusion::kHidden);
}

TEST(OcclusionUpTo, TellsWhereTheOtherEdgeGoesOn) {
  constexpr double kOutsidePx = 7;
  EXPECT_EQ(Seen(RenderScene(SceneWithMarkers()).bgr, kBevelPx), Occlusion::kNone);
  EXPECT_EQ(Seen(WithMirroringBevel(SceneWithMarkers()), kOutsidePx), Occlusion::kNone);
}

TEST(OcclusionUpTo, DoesNotTellFromANarrowBand) {
  constexpr double kInsidePx = 7, kNarrowPx = 2;
  EXPECT_EQ(Seen(WithMirroringBevel(SceneWithMarkers()), -kInsidePx, kNarrowPx),
            Occlusion::kUntold);
}

TEST(OcclusionUpTo, TellsWhereTheOtherEdgeGoesOnInAShadow) {
  constexpr double kDarker = 60;
  const cv::Mat picture = Grained(BrightenedAlongUpperEdge(
      SceneWithMarkers(), -kBevelPx, 0, [](double, double) { return -kDarker; }));
  EXPECT_EQ(Seen(picture, kBevelPx), Occlusion::kNone);
}

// Which then hides the other blade's edge although it lies on that and beside it.
TEST(OcclusionUpTo, DoesNotTellInAShadowAsDarkAsTheOtherBlade) {
  constexpr double kDepthPx = 4;
  const SceneSpec spec = SceneWithMarkers();
  const Measured measured{spec};
  const LocatedEdgePoint& p = measured.blades.lower.used.front();
  const Eigen::Vector2d on_blade = p.trend_px - kDepthPx * p.normal;
  const uchar tone = measured.photo.grey().at<uchar>(cv::Point2d(on_blade.x(), on_blade.y()));
  const cv::Mat picture = RetouchedAlongUpperEdge(
      spec, -kBevelPx, 0, [&](const cv::Vec3d&, double, double) { return cv::Vec3d::all(tone); });
  EXPECT_EQ(Seen(picture, kBevelPx), Occlusion::kUntold);
}

}  // namespace
}  // namespace bladecurve
