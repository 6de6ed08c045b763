// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/occluding_border.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "measured_blades.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

using testing::kBevelPx;
using testing::Measured;
using testing::RetouchedAlongUpperEdge;
using testing::SceneWithMarkers;
using testing::WithBrightBevel;
using testing::WithShadowBeside;

// What becomes of the lower blade's edge, in `picture`, up to a line that lies so far outwards of
// the true upper edge, that having been found so far inwards of the line.
Occlusion Seen(const cv::Mat& picture, double border_px, double inwards_px = kBevelPx) {
  Measured measured{SceneWithMarkers()};
  LocatedBlade& upper = measured.blades.upper;
  measured.Misplace(&upper, border_px);
  const std::vector<LocatedEdgePoint> border = upper.used;
  measured.Misplace(&upper, -inwards_px);
  measured.photo = Measured::PhotoOf(picture);
  return OcclusionUpTo(measured.View(), border, upper.used, measured.blades.lower.used);
}

TEST(OcclusionUpTo, TellsWhereABevelHidesTheOtherEdge) {
  EXPECT_EQ(Seen(WithBrightBevel(SceneWithMarkers()), 0), Occlusion::kHidden);
}

TEST(OcclusionUpTo, TellsWhereTheOtherEdgeGoesOn) {
  constexpr double kOutsidePx = 7;
  EXPECT_EQ(Seen(RenderScene(SceneWithMarkers()).bgr, kBevelPx), Occlusion::kNone);
  EXPECT_EQ(Seen(WithBrightBevel(SceneWithMarkers()), kOutsidePx), Occlusion::kNone);
}

TEST(OcclusionUpTo, DoesNotTellFromANarrowBand) {
  constexpr double kInsidePx = 7, kNarrowPx = 2;
  EXPECT_EQ(Seen(WithBrightBevel(SceneWithMarkers()), -kInsidePx, kNarrowPx), Occlusion::kUntold);
}

TEST(OcclusionUpTo, TellsWhereTheOtherEdgeGoesOnInAShadow) {
  EXPECT_EQ(Seen(WithShadowBeside(SceneWithMarkers(), kBevelPx), kBevelPx), Occlusion::kNone);
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

// The web that joins some blades at the crotch hides the other edge there, but is no bevel, which
// would go on.
TEST(OcclusionUpTo, DoesNotTellFromWhatFillsTheCrotch) {
  constexpr double kBrighter = 12;
  const SceneSpec spec = SceneWithMarkers();
  const cv::Vec3d web = cv::Vec3d(RenderScene(spec).bgr.at<cv::Vec3b>(spec.height / 2, 10)) +
                        cv::Vec3d::all(kBrighter);
  const auto filled_up_to = [&](double end) {
    return RetouchedAlongUpperEdge(
        spec, -kBevelPx, 0, [&](const cv::Vec3d& sheet, double, double share) {
          return share < end ? web : sheet;
        });
  };
  EXPECT_EQ(Seen(filled_up_to(1), kBevelPx), Occlusion::kHidden);
  EXPECT_EQ(Seen(filled_up_to(0.2), kBevelPx), Occlusion::kUntold);
}

// The other blade is the top one: what hides its edge is not this blade.
TEST(OcclusionUpTo, DoesNotTellWhereTheOtherEdgeIsSeenOnTheBlade) {
  SceneSpec spec = SceneWithMarkers();
  spec.scissors.upper_on_top = false;
  EXPECT_EQ(Seen(WithBrightBevel(spec), 0), Occlusion::kUntold);
}

// Whether the upper edge, found so far outwards of the truth, is confirmed although there is a line
// so far out of it.
bool Confirms(const cv::Mat& picture, double outwards_px, double rival_px) {
  constexpr double kDoubtPx = 3, kKnownPx = 1;
  Measured measured{SceneWithMarkers()};
  LocatedEdge& edge = measured.blades.upper.edge;
  measured.Misplace(&measured.blades.upper, outwards_px);
  Measured::MakeClear(&measured.blades.upper);
  SetRival(&edge, rival_px);
  DoubtForRival(&edge, kDoubtPx);
  measured.photo = Measured::PhotoOf(picture);
  ConfirmByOcclusion(measured.View(), measured.blades.lower.edge, &edge);
  EXPECT_EQ(edge.ambiguity < 0.5, edge.common_sigma_px < kKnownPx);
  return edge.ambiguity < 0.5;
}

TEST(ConfirmByOcclusion, DoubtsNoBorderForALineWithinOrBeyondIt) {
  const cv::Mat bevelled = WithBrightBevel(SceneWithMarkers());
  const cv::Mat plain = RenderScene(SceneWithMarkers()).bgr;
  EXPECT_TRUE(Confirms(bevelled, 0, -kBevelPx));
  EXPECT_FALSE(Confirms(bevelled, -kBevelPx, kBevelPx)) << "the line is the border";
  EXPECT_TRUE(Confirms(plain, 0, kBevelPx));
  EXPECT_FALSE(Confirms(plain, kBevelPx, -kBevelPx)) << "the line is the border";
}

}  // namespace
}  // namespace bladecurve
