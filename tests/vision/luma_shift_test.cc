// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/luma_shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/edge_images.h"
#include "vision/image/blurred_step.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kSteel(0.36, 0.35, 0.35), kGold(0.14, 0.28, 0.36);
const Vector3d kBlue(0.4, 0.12, 0.03), kGreen(0.12, 0.25, 0.02), kRed(0.03, 0.02, 0.25);

double Stored(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

// A blade in the upper half of a photograph, as its grey version shows it. Its edge lies a little
// inclined about y = `edge_y_px`.
constexpr int kBlockedSide = 120;
cv::Mat GreyPhotograph(const Vector3d& blade,
                       const Vector3d& ground,
                       double edge_y_px,
                       double blur_px) {
  const Vector2d normal = testing::Direction(1.5);
  const cv::Mat coverage =
      testing::HalfPlaneCoverage({kBlockedSide, kBlockedSide},
                                 normal,
                                 normal.dot(Vector2d(kBlockedSide / 2.0, edge_y_px)),
                                 blur_px);
  cv::Mat bgr(coverage.size(), CV_8UC3), grey;
  for (int y = 0; y < kBlockedSide; ++y) {
    for (int x = 0; x < kBlockedSide; ++x) {
      const Vector3d light = blade + coverage.at<double>(y, x) * (ground - blade);
      for (int c = 0; c < 3; ++c)
        bgr.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(Stored(light[c]));
    }
  }
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

// How far out of the blade its edge is located, in standard deviations of its blur.
double LocatedShift(const Vector3d& blade, const Vector3d& ground, double blur_px) {
  constexpr double kEdge = 60.3;
  const Vector2d normal = testing::Direction(1.5), along(normal.y(), -normal.x());
  const Vector2d middle(kBlockedSide / 2.0, kEdge);
  const EdgeGuess guess{{middle - 45 * along, middle + 45 * along}, true};
  const LocatedEdge edge =
      LocateEdge(GreyPhotograph(blade, ground, kEdge, blur_px), SrgbToneCurve(), guess);
  double sum = 0;
  for (const LocatedEdgePoint& point : edge.points) sum += normal.dot(point.trend_px - middle);
  return sum / static_cast<double>(edge.points.size()) / std::sqrt(TotalBlurVariance(blur_px));
}

TEST(LumaShift, IsWhatEdgesInGreyAreOffBy) {
  constexpr double kClose = 0.03, kWorthwhile = 0.05;
  const std::vector<std::pair<Vector3d, Vector3d>> sides = {
      {kSteel, kBlue}, {kSteel, kGreen}, {kSteel, kRed}, {kGold, kBlue}};
  for (const auto& [blade, ground] : sides) {
    const double shift = LumaShift(blade, ground, SrgbToneCurve());
    EXPECT_GT(shift, kWorthwhile) << ground.transpose();
    for (const double blur_px : {0.7, 1.5})
      EXPECT_NEAR(LocatedShift(blade, ground, blur_px), shift, kClose) << ground.transpose();
  }
}

TEST(LumaShift, IsNoneBetweenGreysOrColoursOfOneHue) {
  constexpr double kNone = 2e-3;
  const ToneCurve tone = SrgbToneCurve();
  EXPECT_NEAR(LumaShift(Vector3d::Constant(0.6), Vector3d::Constant(0.02), tone), 0, kNone);
  EXPECT_NEAR(LumaShift(kGold, 0.5 * kGold, tone), 0, 0.02);
}

TEST(LumaShift, TurnsRoundWithTheEdge) {
  const ToneCurve tone = SrgbToneCurve();
  EXPECT_NEAR(LumaShift(kSteel, kGreen, tone), -LumaShift(kGreen, kSteel, tone), 1e-9);
}

TEST(LumaShift, IsBoundedWhereColoursLookAlikeInGrey) {
  const ToneCurve tone = SrgbToneCurve();
  const Vector3d alike = LightInGrey(kSteel, tone) / LightInGrey(kGreen, tone) * kGreen;
  for (const double brighter : {0.9, 0.99, 1.0, 1.01, 1.1})
    EXPECT_LE(std::abs(LumaShift(kSteel, brighter * alike, tone)), 0.5) << brighter;
}

TEST(LightInGrey, IsTheLightOfGreysAndAsGreenAsTheEyeSees) {
  const ToneCurve tone = SrgbToneCurve();
  EXPECT_NEAR(LightInGrey(Vector3d::Constant(0.3), tone), 0.3, 1e-6);
  EXPECT_GT(LightInGrey({0, 0.5, 0}, tone), LightInGrey({0, 0, 0.5}, tone));
  EXPECT_GT(LightInGrey({0, 0, 0.5}, tone), LightInGrey({0.5, 0, 0}, tone));
}

}  // namespace
}  // namespace bladecurve
