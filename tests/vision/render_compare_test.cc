// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/render/render.h"

namespace bladecurve {
namespace {

struct Drawn {
  cv::Mat grey;
  std::vector<Eigen::Vector2d> edge_px;  // the free part of the upper blade's edge
};

Drawn RenderedEdge() {
  SceneSpec scene;
  scene.width = 1200;
  scene.height = 900;
  scene.camera.mm_per_px = 0.22;
  scene.camera.blur_px = 1.0;
  scene.light.shadow = 0;
  scene.light.contact_shadow = 0;
  const RenderedPhoto photo = RenderScene(scene);
  Drawn drawn;
  cv::cvtColor(photo.bgr, drawn.grey, cv::COLOR_BGR2GRAY);
  const EdgeTruth& edge = photo.truth.upper;
  const double from_mm = edge.free_from_mm + 4, to_mm = edge.shape.to_mm - 2;
  for (std::size_t i = 0; i < edge.px.size(); ++i) {
    if (edge.blade_mm[i].x() > from_mm && edge.blade_mm[i].x() < to_mm)
      drawn.edge_px.push_back(edge.px[i]);
  }
  return drawn;
}

// The upper blade lies above its edge, which runs to the right.
constexpr bool kBladeOnLeft = true;

std::vector<Eigen::Vector2d> MovedOutwards(const std::vector<Eigen::Vector2d>& edge, double px) {
  const Eigen::Vector2d along = (edge.back() - edge.front()).normalized();
  const Eigen::Vector2d outwards(-along.y(), along.x());
  std::vector<Eigen::Vector2d> moved;
  for (const Eigen::Vector2d& p : edge) moved.push_back(p + px * outwards);
  return moved;
}

TEST(CompareDrawnEdge, FindsNoShiftInARenderedPhotograph) {
  const Drawn drawn = RenderedEdge();
  const EdgeAgreement agreement =
      CompareDrawnEdge(drawn.grey, SrgbToneCurve(), drawn.edge_px, kBladeOnLeft);
  ASSERT_GE(agreement.windows, 3);
  constexpr double kNoiseAndMetal =
      0.02;  // px, of a mean over some windows; bevel and streaks included
  EXPECT_NEAR(agreement.shift_px, 0, kNoiseAndMetal);
  EXPECT_NEAR(agreement.blur_px, 1.0, 0.26);  // to the neighbours among those tried
  EXPECT_LT(agreement.residual, 0.05);
}

TEST(CompareDrawnEdge, FindsHowFarTheDrawingIsOff) {
  const Drawn drawn = RenderedEdge();
  const double at_rest =
      CompareDrawnEdge(drawn.grey, SrgbToneCurve(), drawn.edge_px, kBladeOnLeft).shift_px;
  constexpr double kTakenUp = 0.06;  // of a displacement, by the fitted slopes and blur
  for (const double px : {-0.5, -0.2, 0.4}) {
    const EdgeAgreement agreement = CompareDrawnEdge(
        drawn.grey, SrgbToneCurve(), MovedOutwards(drawn.edge_px, px), kBladeOnLeft);
    EXPECT_NEAR(agreement.shift_px - at_rest, -px, kTakenUp * std::abs(px))
        << "moved by " << px << " px";
  }
}

TEST(CompareDrawnEdge, FindsNothingOnABlankPicture) {
  const Drawn drawn = RenderedEdge();
  const cv::Mat blank(drawn.grey.size(), CV_8U, cv::Scalar(180));
  const EdgeAgreement agreement =
      CompareDrawnEdge(blank, SrgbToneCurve(), drawn.edge_px, kBladeOnLeft);
  EXPECT_EQ(agreement.windows, 0);
  EXPECT_TRUE(std::isnan(agreement.shift_px));
}

}  // namespace
}  // namespace bladecurve
