// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_crescents.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "vision/image/tone_curve.h"
#include "vision/pivot/screw.h"
#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kSide = 81, kFiner = 4;
constexpr double kRadiusPx = 13, kChamferPx = 2;
const Vector2d kCenter(40.3, 39.6);

// A head that stands up on a plate, in linear light: its top, a chamfer that is lit towards the
// lamp and dark away from it, and the shadow that it casts.
struct Head {
  double top = 0, plate = 0.3, glint = 0.9, dark = 0.05;
  double shadow_px = 2;
  double half_lit = 0.6;  // cosine: of a glint, to its middle
};

// The first lamp casts the shadow.
double LightAt(const Vector2d& place, const Head& head, const std::vector<Vector2d>& to_lamps) {
  const Vector2d out = place - kCenter;
  if (out.norm() < kRadiusPx) return head.top;
  if (out.norm() < kRadiusPx + kChamferPx) {
    const bool shines = std::any_of(to_lamps.begin(), to_lamps.end(), [&](const Vector2d& lamp) {
      return out.normalized().dot(lamp) > head.half_lit;
    });
    return shines ? head.glint : head.dark;
  }
  return (out + head.shadow_px * to_lamps.front()).norm() < kRadiusPx + kChamferPx ? head.dark
                                                                                   : head.plate;
}

// CV_32F, linear.
cv::Mat RaisedHead(const Head& head, const std::vector<Vector2d>& to_lamps) {
  constexpr double kBlurPx = 0.7;
  cv::Mat fine(kSide * kFiner, kSide * kFiner, CV_32FC1), light;
  for (int y = 0; y < fine.rows; ++y) {
    for (int x = 0; x < fine.cols; ++x) {
      const Vector2d place((x + 0.5) / kFiner - 0.5, (y + 0.5) / kFiner - 0.5);
      fine.at<float>(y, x) = static_cast<float>(LightAt(place, head, to_lamps));
    }
  }
  cv::GaussianBlur(fine, fine, {}, kFiner * kBlurPx);
  cv::resize(fine, light, {kSide, kSide}, 0, 0, cv::INTER_AREA);
  return light;
}

cv::Mat Encoded(const cv::Mat& light) {
  cv::Mat grey(light.size(), CV_8UC1), noise(light.size(), CV_32FC1);
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 0, 1);
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      const double l = light.at<float>(y, x);
      const double srgb = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
      grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(255 * srgb + noise.at<float>(y, x));
    }
  }
  return grey;
}

std::optional<Screw> FindIn(const cv::Mat& grey) {
  ScrewSearch search;
  search.guess_px = kCenter + Vector2d(2, -1);
  search.radius_px = 6;
  search.min_semi_axis_px = 8;
  search.max_semi_axis_px = 20;
  return FindScrew(grey, SrgbToneCurve(), search);
}

Vector2d Towards(double turns) {
  const double angle = 2 * std::numbers::pi * turns;
  return {std::cos(angle), std::sin(angle)};
}

// `lamps`: where they stand, in turns about the head.
void ExpectCentre(const Head& head, double within_px, const std::vector<double>& lamps = {0}) {
  constexpr double kSigmas = 2.5;
  constexpr int kTurns = 6;
  for (int turn = 0; turn < kTurns; ++turn) {
    SCOPED_TRACE(turn);
    std::vector<Vector2d> to_lamps;
    for (const double lamp : lamps) to_lamps.push_back(Towards((turn + 0.3) / kTurns + lamp));
    const std::optional<Screw> screw = FindIn(Encoded(RaisedHead(head, to_lamps)));
    ASSERT_TRUE(screw);
    const Vector2d off = screw->center_px - kCenter;
    EXPECT_LT(off.norm(), within_px);
    EXPECT_LT(off.dot(screw->covariance_px2.inverse() * off), kSigmas * kSigmas);
  }
}

// A rim that rises, or falls, all round lies aside by up to half of chamfer and shadow.
TEST(LeaveCrescents, TakesTheCentreOfARaisedHeadBackBeforeTheLamp) {
  ExpectCentre({.top = 0.15}, 0.6);
  ExpectCentre({.top = 0.45}, 0.6);
}

TEST(LeaveCrescents, TakesItBackByAWideShadowToo) {
  ExpectCentre({.top = 0.22, .shadow_px = 6}, 1.2);
}

// White is as bright as a glint gets.
TEST(LeaveCrescents, TakesItBackOnABrightPlateToo) {
  for (const double glint : {1.0, 1.4})
    ExpectCentre({.top = 0.35, .plate = 0.75, .glint = glint, .dark = 0.15, .shadow_px = 3}, 1);
}

// A rim that rises is followed along the inner borders of the glints.
TEST(LeaveCrescents, TakesItToTheFootThatTwoGlintsShow) {
  ExpectCentre(
      {.top = 0.3, .plate = 0.45, .glint = 1.4, .dark = 0.3, .shadow_px = 0, .half_lit = 0.9},
      0.75,
      {0, 0.32});
}

TEST(LeaveCrescents, LeavesARimThatHasNone) {
  cv::Mat light(kSide, kSide, CV_32FC1, cv::Scalar(0.3));
  cv::circle(light, {40, 40}, 13, cv::Scalar(0.15), cv::FILLED);
  cv::circle(light, {40, 40}, 14, cv::Scalar(0.6), 2);
  RimFit fit;
  fit.rim = RimEllipse::Circle({40.2, 40.1}, 13.5);
  fit.center_covariance = 0.01 * Eigen::Matrix2d::Identity();
  const RimFit left = LeaveCrescents(light, fit);
  EXPECT_EQ(left.rim.center, fit.rim.center) << "a ring lit all round";
  EXPECT_EQ(left.center_covariance, fit.center_covariance);
}

}  // namespace
}  // namespace bladecurve
