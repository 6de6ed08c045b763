// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace bladecurve {
namespace {

constexpr double kHeadLight = 0.2, kGroundLight = 0.5;

// Light of a place, px from the head's centre.
using Light = std::function<double(const Eigen::Vector2d&)>;

// A dark head on uneven ground, with a blur of 1 px.
struct HeadOnGround {
  cv::Mat picture;
  RimEllipse rim;
};

HeadOnGround DrawHead(double radius, const Light& uneven) {
  const int side = 2 * static_cast<int>(1.5 * radius + 8) + 1;
  HeadOnGround head{cv::Mat(side, side, CV_32F),
                    RimEllipse::Circle({side / 2 + 0.3, side / 2 - 0.2}, radius)};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Eigen::Vector2d p = Eigen::Vector2d(x, y) - head.rim.center;
      const double seen = 0.5 * std::erfc((radius - p.norm()) / std::numbers::sqrt2);
      head.picture.at<float>(y, x) =
          static_cast<float>(kHeadLight + seen * (kGroundLight + uneven(p) - kHeadLight));
    }
  }
  return head;
}

// How uneven the ground is in the ring where the rim is sought: rms about its mean.
double UnevenBesideRim(const cv::Mat& picture, const RimEllipse& rim) {
  constexpr double kFromPx = 2, kToPx = 6;  // clear of most of the rim
  double sum = 0, squares = 0;
  int count = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double off = (Eigen::Vector2d(x, y) - rim.center).norm() - rim.MeanRadius();
      if (off < kFromPx || off > kToPx) continue;
      const double light = picture.at<float>(y, x);
      sum += light;
      squares += light * light;
      ++count;
    }
  }
  const double mean = sum / count;
  return std::sqrt(squares / count - mean * mean);
}

void ExpectSmoothed(const HeadOnGround& head, double least_times) {
  const cv::Mat even = WithEvenGround(head.picture, head.rim);
  EXPECT_GT(UnevenBesideRim(head.picture, head.rim) / UnevenBesideRim(even, head.rim), least_times);
  const int middle = even.rows / 2;
  EXPECT_FLOAT_EQ(even.at<float>(middle, middle), kHeadLight);
}

// Streaks of 6 px beside each other, no two alike, at 25 degrees.
double Streak(const Eigen::Vector2d& p) {
  const double across = -std::sin(0.44) * p.x() + std::cos(0.44) * p.y();
  return 0.03 * std::sin(across) + 0.02 * std::sin(0.61 * across + 1);
}

TEST(WithEvenGround, TakesShadingOut) {
  const double radius = 30;
  ExpectSmoothed(DrawHead(radius,
                          [&](const Eigen::Vector2d& p) {
                            const Eigen::Vector2d q = p / radius;
                            return 0.04 * q.x() - 0.03 * q.y() + 0.03 * q.x() * q.y();
                          }),
                 10);
}

TEST(WithEvenGround, TakesStreaksOut) {
  for (const double radius : {20.0, 40.0, 60.0}) {
    SCOPED_TRACE(radius);
    ExpectSmoothed(DrawHead(radius, Streak), 3);
  }
}

// At a lower resolution, that is.
TEST(WithEvenGround, TakesStreaksOutAboutLargeHeads) {
  const double radius = 150;
  ExpectSmoothed(DrawHead(radius, [](const Eigen::Vector2d& p) { return Streak(p / 3); }), 3);
}

TEST(WithEvenGround, LeavesEvenGroundAlone) {
  const HeadOnGround head = DrawHead(30, [](const Eigen::Vector2d&) { return 0; });
  const cv::Mat even = WithEvenGround(head.picture, head.rim);
  EXPECT_LT(cv::norm(even, head.picture, cv::NORM_INF), 2e-4);
}

// What is no ground, such as the border of the blade, neither bends the shading nor makes streaks.
TEST(WithEvenGround, IsNotLedAstrayByWhatIsNoGround) {
  const double radius = 40;
  const HeadOnGround head =
      DrawHead(radius, [&](const Eigen::Vector2d& p) { return p.x() > 1.3 * radius ? -0.4 : 0.0; });
  const cv::Mat even = WithEvenGround(head.picture, head.rim);
  const cv::Mat left = even.colRange(0, even.cols * 3 / 4);
  EXPECT_LT(cv::norm(left, head.picture.colRange(0, even.cols * 3 / 4), cv::NORM_INF), 2e-3);
}

}  // namespace
}  // namespace bladecurve
