// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/pivot/screw.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

constexpr int kLamps = 6;
constexpr double kScrewMmPerPx = 0.07;

// A rendered head with a rounded rim, the lamp in one of kLamps directions.
RenderedPhoto LitHead(int lamp, double glint) {
  SceneSpec scene;
  scene.seed = static_cast<std::uint32_t>(lamp + 1);
  scene.width = 1200;
  scene.height = 900;
  scene.camera.mm_per_px = kScrewMmPerPx;
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

// Over all lamps.
struct Errors {
  double rms_px = 0;        // of a coordinate
  double rms_sigma_px = 0;  // what the covariance says it is
  int inside = 0;           // heads within their ellipse of 95 %
};

Errors ErrorsOverLamps(double glint) {
  constexpr double kChiSquare = 5.991;  // of two coordinates, 95 %
  const double radius_px = ScissorsSpec().screw_radius_mm / kScrewMmPerPx;
  double squares = 0, variances = 0;
  Errors errors;
  for (int lamp = 0; lamp < kLamps; ++lamp) {
    const RenderedPhoto photo = LitHead(lamp, glint);
    const std::optional<Screw> screw = FindNear(photo, radius_px);
    EXPECT_TRUE(screw) << "lamp " << lamp;
    if (!screw) continue;
    const Eigen::Vector2d error = screw->center_px - photo.truth.screw_px;
    squares += error.squaredNorm() / 2;
    variances += screw->covariance_px2.trace() / 2;
    if (error.dot(screw->covariance_px2.inverse() * error) < kChiSquare) ++errors.inside;
  }
  errors.rms_px = std::sqrt(squares / kLamps);
  errors.rms_sigma_px = std::sqrt(variances / kLamps);
  return errors;
}

TEST(ScrewRefinement, IsExactUnderALightFromEverywhereAndSure) {
  const Errors errors = ErrorsOverLamps(0);
  EXPECT_LT(errors.rms_px, 0.05);
  EXPECT_LT(errors.rms_sigma_px, 3 * errors.rms_px);
}

// The bright arc within the rim on the lamp's side draws a fit that takes the rim for alike all
// round by half a pixel and more; the scatter along the rim does not show it.
TEST(ScrewRefinement, ALampOnOneSideHardlyMovesTheCenter) {
  for (const double glint : {0.5, 0.7, 0.9}) {
    const Errors errors = ErrorsOverLamps(glint);
    EXPECT_LT(errors.rms_px, 0.15) << glint;
    EXPECT_GE(errors.inside, kLamps - 1) << glint;
  }
}

TEST(ScrewRefinement, KnowsHowFarAGlareMovesTheCenter) {
  EXPECT_GE(ErrorsOverLamps(1.2).inside, kLamps - 1);
}

}  // namespace
}  // namespace bladecurve
