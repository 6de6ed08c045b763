// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_place.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kMmPerPx = 0.1, kFocalPx = 2000, kAsidePx = 300;
constexpr int kWidth = 1001, kHeight = 751;
const Vector2d kMiddle(500, 375), kHead = kMiddle + Vector2d(kAsidePx, 0);

// A head to the right of the picture's middle.
Screw HeadAside() {
  Screw screw{};
  screw.center_px = kHead;
  screw.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  screw.semi_major_px = screw.semi_minor_px = 20;
  screw.evidence = 100;
  screw.third_support = 1;
  return screw;
}

PlacePx FootSeenBy(std::optional<CameraKnowledge> camera) {
  ScaleResult scale;
  scale.map = PlaneMap::Uniform(kMmPerPx, 0, "mm-per-px");
  scale.camera = std::move(camera);
  Scene scene;
  scene.shank_width_px = 50;
  return FootBelow(HeadAside(), scale, scene);
}

CameraKnowledge CameraWith(double log_focal_sigma) {
  return {CentredCamera(kFocalPx, kWidth, kHeight), log_focal_sigma, 0};
}

TEST(FootBelow, LiesNearerToTheMiddleThanTheHeadIfTheCameraIsKnown) {
  constexpr double kCloseMm = 0.01;
  const double leaning_px = kHeadMm / kMmPerPx * kAsidePx / kFocalPx;
  const PlacePx foot = FootSeenBy(CameraWith(kCalibratedFocalSigma));
  EXPECT_NEAR(foot.point_px.x(), kHead.x() - leaning_px, kCloseMm / kMmPerPx);
  EXPECT_NEAR(foot.point_px.y(), kHead.y(), kCloseMm / kMmPerPx);
}

TEST(FootBelow, MayLieThereIfItIsNot) {
  const double leaning_px = kHeadMm / kMmPerPx * kAsidePx / kFocalPx;
  const PlacePx foot = FootSeenBy(CameraWith(0.6));
  const PlacePx known = FootSeenBy(CameraWith(kCalibratedFocalSigma));
  EXPECT_EQ(foot.point_px, kHead);
  EXPECT_GT(std::sqrt(foot.covariance_px2(0, 0)), leaning_px);
  EXPECT_LT(foot.covariance_px2(1, 1), 0.5 * foot.covariance_px2(0, 0)) << "along the way only";
  EXPECT_LT(known.covariance_px2(0, 0), foot.covariance_px2(0, 0));
}

TEST(FootBelow, LiesBelowTheHeadOfAScan) {
  const PlacePx foot = FootSeenBy(std::nullopt);
  EXPECT_EQ(foot.point_px, kHead);
  EXPECT_NEAR(foot.covariance_px2(0, 0), foot.covariance_px2(1, 1), 1e-9);
}

}  // namespace
}  // namespace bladecurve
