// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/render.h"
#include "vision/screw.h"

namespace bladecurve {
namespace {

constexpr int kLamps = 6;
constexpr double kMmPerPx = 0.07;

// A rendered head with a rounded rim, the lamp in one of kLamps directions.
RenderedPhoto LitHead(int lamp, double glint) {
  SceneSpec scene;
  scene.seed = static_cast<std::uint32_t>(lamp + 1);
  scene.width = 1200;
  scene.height = 900;
  scene.camera.mm_per_px = kMmPerPx;
  scene.light.direction_rad = 2 * std::numbers::pi * lamp / kLamps;
  scene.light.glint = glint;
  return RenderScene(scene);
}

std::optional<Screw> FindNear(const RenderedPhoto& photo, double radius_px) {
  cv::Mat grey;
  cv::cvtColor(photo.bgr, grey, cv::COLOR_BGR2GRAY);
  ScrewSearch search;
  search.guess_px = photo.truth.screw_px + radius_px * Eigen::Vector2d(0.3, -0.2);
  search.radius_px = radius_px;
  search.min_semi_axis_px = 0.55 * radius_px;
  search.max_semi_axis_px = 1.8 * radius_px;
  return FindScrew(grey, SrgbToneCurve(), search);
}

double RmsOverLamps(double glint) {
  const double radius_px = ScissorsSpec().screw_radius_mm / kMmPerPx;
  double squares = 0;
  for (int lamp = 0; lamp < kLamps; ++lamp) {
    const RenderedPhoto photo = LitHead(lamp, glint);
    const std::optional<Screw> screw = FindNear(photo, radius_px);
    EXPECT_TRUE(screw) << "lamp " << lamp;
    if (screw) squares += (screw->center_px - photo.truth.screw_px).squaredNorm() / 2;
  }
  return std::sqrt(squares / kLamps);
}

TEST(ScrewRefinement, IsExactUnderALightFromEverywhere) { EXPECT_LT(RmsOverLamps(0), 0.05); }

// The bright arc within the rim on the lamp's side draws a fit that takes the rim for alike all
// round by half a pixel and more.
TEST(ScrewRefinement, ALampOnOneSideHardlyMovesTheCenter) { EXPECT_LT(RmsOverLamps(0.5), 0.25); }

}  // namespace
}  // namespace bladecurve
