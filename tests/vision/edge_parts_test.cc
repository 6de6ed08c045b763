// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The pieces an edge is located with: the blurred step, the smoother, the band of raw pixels, the
// choice of the transition.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>
#include <vector>

#include "vision/edge/edge_band.h"
#include "vision/edge/edge_choice.h"
#include "vision/edge/edge_debug.h"
#include "vision/edge/edge_path.h"
#include "vision/edge_images.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Direction;
using testing::Gaussian;

constexpr double kTableError = 3e-5;  // flanks of the trapezoid widened to 0.02 px

TEST(BlurredStep, EqualsTheBlurredHalfPlaneAveragedOverThePixel) {
  Gaussian random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector2d normal = Direction(2 * std::numbers::pi * random.Uniform());
    const double blur = 0.3 + 2 * random.Uniform(), across = 6 * (random.Uniform() - 0.5);
    const cv::Mat pixel = testing::HalfPlaneCoverage({1, 1}, normal, -across, blur);
    EXPECT_NEAR(BlurredStep(normal, blur).At(across).step, pixel.at<double>(0, 0), kTableError)
        << "normal " << normal.transpose() << " blur " << blur << " across " << across;
  }
}

TEST(BlurredStep, DerivativesEqualCentralDifferences) {
  constexpr double kStep = 1e-4, kTolerance = 1e-5;
  Gaussian random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector2d normal = Direction(2 * std::numbers::pi * random.Uniform());
    const double blur = 0.4 + 2 * random.Uniform(), across = 5 * (random.Uniform() - 0.5);
    const StepSample sample = BlurredStep(normal, blur).At(across);
    const BlurredStep step(normal, blur), sharper(normal, blur - kStep),
        softer(normal, blur + kStep);
    EXPECT_NEAR(sample.slope,
                (step.At(across + kStep).step - step.At(across - kStep).step) / (2 * kStep),
                kTolerance);
    EXPECT_NEAR(sample.spread,
                (softer.At(across).step - sharper.At(across).step) / (2 * kStep),
                kTolerance);
  }
}

TEST(SmoothValues, SolvesItsNormalEquations) {
  constexpr int kCount = 30;
  constexpr double kStiffness = 3.7, kTolerance = 1e-10;
  Gaussian random(3);
  std::vector<double> values, weights;
  for (int i = 0; i < kCount; ++i) {
    values.push_back(random());
    weights.push_back(i % 7 == 3 ? 0 : random.Uniform());
  }
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kCount, kCount);
  Eigen::VectorXd right(kCount);
  for (int i = 0; i < kCount; ++i) {
    normal(i, i) += weights[static_cast<size_t>(i)];
    right[i] = weights[static_cast<size_t>(i)] * values[static_cast<size_t>(i)];
  }
  for (int i = 1; i + 1 < kCount; ++i) {
    Eigen::VectorXd bend = Eigen::VectorXd::Zero(kCount);
    bend.segment(i - 1, 3) << 1, -2, 1;
    normal += kStiffness * bend * bend.transpose();
  }
  const Eigen::VectorXd expected = normal.fullPivLu().solve(right);
  const std::vector<double> smooth = SmoothValues(values, weights, kStiffness);
  for (int i = 0; i < kCount; ++i)
    EXPECT_NEAR(smooth[static_cast<size_t>(i)], expected[i], kTolerance);
}

TEST(SmoothPath, NormalsPointOutOfTheBladeAndCurvatureIsPositiveForAConvexOne) {
  constexpr double kRadius = 80;
  std::vector<Vector2d> arc;
  for (int i = 0; i <= 60; ++i) arc.push_back(Vector2d(100, 100) + kRadius * Direction(0.02 * i));
  // Walking with growing angle, y down, the centre lies on the right.
  const EdgePath path = SmoothPath(arc, false, 1);
  for (int i = 10; i + 10 < path.size(); ++i) {
    const Vector2d outwards =
        (path.points[static_cast<size_t>(i)] - Vector2d(100, 100)).normalized();
    EXPECT_GT(path.normals[static_cast<size_t>(i)].dot(outwards), 0.999);
    EXPECT_NEAR(path.curvatures[static_cast<size_t>(i)] * kRadius, 1, 0.02);
  }
}

TEST(SmoothPath, RefusesAPointWithoutLength) {
  EXPECT_THROW((void)SmoothPath({Vector2d(3, 3), Vector2d(3, 3)}, true, 1), Refused);
}

// Two thirds of a circle pass through every direction, so scanning lines change from columns to
// rows and back.
TEST(GatherPixels, FindsEachPixelBesideAnArcOnceAndAtItsDistance) {
  constexpr double kRadius = 40, kReach = 5, kDistanceTolerance = 5e-3, kSpan = 4;
  const Vector2d center(60.3, 59.6);
  std::vector<Vector2d> arc;
  for (int i = 0; i <= 400; ++i) arc.push_back(center + kRadius * Direction(kSpan * i / 400));
  const EdgePath path = SmoothPath(arc, false, 0);
  cv::Mat grey(121, 121, CV_8U);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x)
      grey.at<uchar>(y, x) = static_cast<uchar>((7 * x + 13 * y) % 251);
  }
  const std::vector<double> reach(path.points.size(), kReach);
  const PixelBand band = GatherPixels(grey, testing::GammaCurve(1), path, {reach, reach});

  // Well inside the band and the span each pixel must be there; the multiset of their values tells
  // which.
  std::multiset<int> expected;
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const Vector2d from_center = Vector2d(x, y) - center;
      double angle = std::atan2(from_center.y(), from_center.x());
      if (angle < -0.5) angle += 2 * std::numbers::pi;
      const double along = kRadius * angle;
      if (std::abs(from_center.norm() - kRadius) <= kReach && along >= -0.5 &&
          along <= kRadius * kSpan + 0.5) {
        expected.insert(grey.at<uchar>(y, x));
      }
    }
  }
  std::multiset<int> found;
  for (const BandPixel& pixel : band.pixels)
    found.insert(static_cast<int>(std::lround(255 * pixel.light)));
  constexpr int kAtTheRim = 16;  // pixels within rounding of the band's border
  std::vector<int> missing;
  std::set_difference(
      expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missing));
  EXPECT_LT(static_cast<int>(missing.size()), kAtTheRim);
  EXPECT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()), kAtTheRim);

  double sum = 0;
  for (const BandPixel& pixel : band.pixels) sum += pixel.across;
  // Mean distance of the pixels of a ring is (reach^2 / 3) / radius.
  EXPECT_NEAR(sum / static_cast<double>(band.pixels.size()),
              kReach * kReach / 3 / kRadius,
              10 * kDistanceTolerance);
}

int Count(const cv::Mat& bgr, const cv::Vec3b& colour) {
  cv::Mat same;
  cv::inRange(bgr, cv::Scalar(colour), cv::Scalar(colour), same);
  return cv::countNonZero(same);
}

// With a lens's blur and noise.
cv::Mat Photographed(const cv::Mat& picture) {
  cv::Mat photographed, noise(picture.size(), CV_16SC1);
  cv::GaussianBlur(picture, photographed, {}, 0.7);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, 2);
  cv::add(photographed, noise, photographed, cv::noArray(), CV_8UC1);
  return photographed;
}

// Of a picture of a blade above a straight border, whose ground is as dark as the bevel from a
// share of the length on: there the line at which the bevel begins is seen alone.
cv::Mat DarkeningGround(int border, int bevel_line, double share) {
  constexpr int kLong = 600, kHigh = 240, kBevelFrom = kLong / 5;
  const cv::Scalar plane(150), bevel(90), ground(150);
  cv::Mat picture(kHigh, kLong, CV_8UC1, bevel);
  picture(cv::Range(0, bevel_line), cv::Range(kBevelFrom, kLong)) = plane;
  picture(cv::Range(border, kHigh), cv::Range(0, static_cast<int>(share * kLong))) = ground;
  return Photographed(picture);
}

TEST(ChooseTransition, ChangesToNoOtherLinePartOfTheWay) {
  constexpr int kBorder = 150, kBevelLine = 138;
  constexpr double kMargin = 20, kSearchPx = 30, kClosePx = 1.5;
  for (const double share : {0.5, 0.6, 0.7}) {
    const cv::Mat picture = DarkeningGround(kBorder, kBevelLine, share);
    const EdgePath guess =
        SmoothPath({{kMargin, kBorder}, {picture.cols - kMargin, kBorder}}, true, 3);
    int far = 0;
    for (const Vector2d& point : ChooseTransition(picture, guess, kSearchPx).points)
      far += std::abs(point.y() - (kBorder - 0.5)) > kClosePx;
    EXPECT_EQ(far, 0) << share;
  }
}

// Of a brushed blade above a straight border: light rises at two streaks along it and falls at the
// border, from a share of the length on no more.
cv::Mat BrushedAlong(int border, double share) {
  constexpr int kLong = 600, kHigh = 240, kFirst = 20, kSecond = 12;  // px from the border
  const cv::Scalar plane(100), streak(145), bright(160), ground(100);
  cv::Mat picture(kHigh, kLong, CV_8UC1, bright);
  picture.rowRange(0, border - kSecond) = streak;
  picture.rowRange(0, border - kFirst) = plane;
  picture(cv::Range(border, kHigh), cv::Range(0, static_cast<int>(share * kLong))) = ground;
  return Photographed(picture);
}

TEST(ChooseTransition, TakesNoStreakForTheBorderBecauseItLiesOutsideOfAnother) {
  constexpr int kBorder = 150;
  constexpr double kMargin = 20, kSearchPx = 30, kClosePx = 1.5;
  for (const double share : {0.75, 0.8, 0.85}) {
    const cv::Mat picture = BrushedAlong(kBorder, share);
    const EdgePath guess =
        SmoothPath({{kMargin, kBorder}, {picture.cols - kMargin, kBorder}}, true, 3);
    std::vector<double> off;
    for (const Vector2d& point : ChooseTransition(picture, guess, kSearchPx).points)
      off.push_back(std::abs(point.y() - (kBorder - 0.5)));
    EXPECT_LT(Median(off), kClosePx) << share;
  }
}

// Light of the parts of a narrow round blade, in grey values.
struct RoundBlade {
  double ridge, flank;
};

constexpr double kEnlargement = 2.1, kBorderOfSmall = 40;
constexpr double kBorderOfEnlarged = kEnlargement * (kBorderOfSmall + 0.5) - 0.5;

// Such a blade above a straight border, enlarged from a picture of few pixels: a ridge between
// flanks that become narrower along it.
cv::Mat EnlargedPicture(const RoundBlade& blade) {
  constexpr int kLong = 80, kHigh = 70;
  constexpr double kGround = 142, kNoise = 1.5;  // grey values
  constexpr double kWide = 7.5, kNarrow = 3, kRidge = 4, kRidgeBlur = 1, kBlur = 1.3;  // px
  cv::Mat picture(kHigh, kLong, CV_64F);
  for (int x = 0; x < kLong; ++x) {
    const double flank = kWide + (kNarrow - kWide) * x / kLong;
    for (int y = 0; y < kHigh; ++y) {
      const double d = y - kBorderOfSmall;
      const double ridge =
          testing::Smooth(d + flank + kRidge, kRidgeBlur) - testing::Smooth(d + flank, kRidgeBlur);
      const double metal =
          testing::Smooth(d + 2 * flank + kRidge, kBlur) - testing::Smooth(d, kBlur);
      picture.at<double>(y, x) =
          kGround * (1 - metal) + blade.ridge * ridge + blade.flank * (metal - ridge);
    }
  }
  cv::Mat enlarged, stored;
  cv::resize(picture, enlarged, {}, kEnlargement, kEnlargement, cv::INTER_CUBIC);
  cv::Mat noise(enlarged.size(), CV_64F);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, kNoise);
  cv::add(enlarged, noise, stored, cv::noArray(), CV_8U);
  return stored;
}

ChosenTransition ChooseInEnlarged(const RoundBlade& blade) {
  constexpr double kMargin = 10, kSearchPx = 13;
  const cv::Mat picture = EnlargedPicture(blade);
  const EdgePath guess = SmoothPath(
      {{kMargin, kBorderOfEnlarged}, {picture.cols - kMargin, kBorderOfEnlarged}}, true, 3);
  return ChooseTransition(picture, guess, kSearchPx);
}

TEST(ChooseTransition, TakesNoRidgeForTheBorderWhereThePictureIsSoft) {
  constexpr double kClosePx = 0.5;
  std::vector<double> off;
  for (const Vector2d& point : ChooseInEnlarged({210, 45}).points)
    off.push_back(std::abs(point.y() - kBorderOfEnlarged));
  EXPECT_LT(Median(off), kClosePx);
}

TEST(ChooseTransition, SeesAFaintBorderAllAlongWhereThePictureIsSoft) {
  EXPECT_GT(ChooseInEnlarged({107, 103}).support, 0.9);
}

TEST(DrawEdge, ShowsEveryPointAsItWasTaken) {
  const cv::Vec3b inlying(80, 220, 80), rejected(60, 60, 255), other(0, 230, 255);
  cv::Mat grey(80, 120, CV_8UC1, cv::Scalar(120));
  LocatedEdge edge;
  for (int i = 0; i < 60; ++i) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = Vector2d(20 + i, 40);
    point.normal = Vector2d(0, 1);
    edge.points.push_back(point);
  }
  const cv::Mat plain = DrawEdge(grey, edge);
  EXPECT_EQ(plain.type(), CV_8UC3);
  EXPECT_GE(Count(plain, inlying), 60);
  EXPECT_EQ(Count(plain, rejected), 0);
  EXPECT_EQ(Count(plain, other), 0);

  edge.points[30].inlier = false;
  edge.points[30].point_px.y() += 200;  // out of sight
  edge.rival_path_px = {Vector2d(50, 46)};
  const cv::Mat doubtful = DrawEdge(grey, edge);
  EXPECT_GE(Count(doubtful, rejected), 1);
  EXPECT_EQ(Count(doubtful, other), 1);
}

}  // namespace
}  // namespace bladecurve
