// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "curvefit/bands.h"
#include "curvefit/fit.h"
#include "fit_errors.h"
#include "simulated_edges.h"

namespace bladecurve {
namespace {

constexpr double kTheta = 0.5;

// Strews a part of the upper edge's points up to `reach_mm` off, to one side as glints do.
EdgePoints WithOutliers(EdgePoints edges, double part, double reach_mm, unsigned seed) {
  Noise noise(seed);
  for (EdgePoint& p : edges.upper) {
    if (noise.Uniform() < part) p.point_mm += (0.15 + reach_mm * noise.Uniform()) * p.normal;
  }
  return edges;
}

// Largest displacement between two fits, in sigmas of the first.
double LargestMove(const BladeFit& clean, const BladeFit& dirty) {
  const CurveBand band(clean.recommended);
  double largest = 0;
  for (double x = 15; x <= 50; x += 1) {
    const double move = clean.recommended.curve.Eval(x, kTheta).phi_mm -
                        dirty.recommended.curve.Eval(x, kTheta).phi_mm;
    largest = std::max(largest, std::abs(move) / band.At(x, kTheta).phi_mm);
  }
  return largest;
}

class Outliers : public testing::TestWithParam<unsigned> {};

TEST_P(Outliers, ThirtyPercentDoNotMoveTheCurveByItsSigma) {
  Noise noise(GetParam());
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  const BladeFit clean = FitBlade({edges});
  const BladeFit dirty = FitBlade({WithOutliers(edges, 0.3, 3, GetParam())});
  EXPECT_LT(LargestMove(clean, dirty), 1);
}

TEST_P(Outliers, SixtyPercentAreFoundOut) {
  Noise noise(GetParam() + 100);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  const BladeFit clean = FitBlade({edges});
  const BladeFit dirty = FitBlade({WithOutliers(edges, 0.6, 5, GetParam())});
  EXPECT_LT(LargestMove(clean, dirty), 2);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Outliers, testing::Range(1u, 9u));

TEST(Outliers, AreListedWithTheirIndex) {
  Noise noise(4);
  EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  for (const int i : {17, 200, 201, 202}) edges.upper[i].point_mm += 0.5 * edges.upper[i].normal;
  const BladeFit fit = FitBlade({edges});
  std::vector<int> found;
  for (const RejectedPoint& p : fit.rejected) {
    if (p.is_upper) found.push_back(p.index);
  }
  EXPECT_EQ(found, (std::vector<int>{17, 200, 201, 202}));
  EXPECT_EQ(fit.recommended.points, fit.recommended.inliers + 4);
}

// The lower edge as a bevel line or a shadow's border would give it.
EdgePoints WithBadLower(EdgePoints edges, double offset_mm, double slope) {
  for (EdgePoint& p : edges.lower) p.point_mm += (offset_mm + slope * p.point_mm.x()) * p.normal;
  return edges;
}

class BadLower : public testing::TestWithParam<double> {};

TEST_P(BadLower, EdgeNeverPullsTheUpperCurve) {
  Noise noise(21);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  const BladeFit fit = FitBlade({WithBadLower(edges, GetParam(), 0.002)});
  const FittedPose& pose = fit.poses[0];
  // In the frame that the fit itself found, the curve runs through the upper points.
  double squares = 0;
  for (const EdgePoint& p : edges.upper) {
    const Eigen::Rotation2Dd turn(-pose.axis_rad);
    const Eigen::Vector2d q = turn * (p.point_mm - pose.pivot_mm);
    const CurveSample s = fit.recommended.curve.Eval(q.x(), pose.theta_rad);
    squares += std::pow((q.y() - s.phi_mm) / std::hypot(1, s.phi_x), 2);
  }
  const double rms = std::sqrt(squares / static_cast<double>(edges.upper.size()));
  EXPECT_LT(rms, 1.1 * 0.02) << "noise of the points is 0.02 mm";
  // And the pivot stays where it was seen, to within its sigma.
  EXPECT_LT(std::abs(pose.pivot_mm.y()), 4 * 0.05);
  EXPECT_LT((pose.pivot_mm - edges.pivot.point_mm).norm(), 0.05);
}
INSTANTIATE_TEST_SUITE_P(Offsets, BadLower, testing::Values(0.05, 0.3, 1.0, 4.0));

TEST(BadLower, GoodOneSharpensThePivot) {
  Noise noise(22);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  EdgePoints alone = edges;
  alone.lower.clear();
  EXPECT_LT(FitBlade({edges}).poses[0].pivot_sigma_mm,
            0.8 * FitBlade({alone}).poses[0].pivot_sigma_mm);
}

TEST(UnderstatedSigma, IsFoundOutAndWidened) {
  SimulatedPhoto photo;
  photo.noise_scale = 3;
  photo.end_along_sigma_mm = 0.02;
  photo.pivot_sigma_mm = 0.005;
  Noise noise(23);
  const BladeFit fit = FitBlade({Photograph(CurvedScissors(), photo, noise)});
  EXPECT_NEAR(fit.edges[0].sigma_scale, 3, 0.5);
}

TEST(Photographs, ThatContradictEachOtherAreReviewed) {
  Noise noise(24);
  SimulatedPhoto wide;
  wide.theta_rad = 1.0;
  const EdgePoints a = Photograph(CurvedScissors(), {}, noise);
  const EdgePoints same = Photograph(CurvedScissors(), wide, noise);
  const EdgePoints other = Photograph(SplineScissors(3, {20, 30, 45}), wide, noise);
  EXPECT_FALSE(Warned(FitBlade({a, same}), "photographs_disagree"));
  EXPECT_TRUE(Warned(FitBlade({a, other}), "photographs_disagree"));
}

TEST(Photographs, OfGivenAnglesThatContradictEachOtherAreReviewed) {
  Noise noise(25);
  SimulatedPhoto photo;
  photo.theta_given = true;
  const EdgePoints a = Photograph(CurvedScissors(), photo, noise);
  EdgePoints b = Photograph(CurvedScissors(), photo, noise);
  b.theta_rad += 0.1;
  EXPECT_TRUE(Warned(FitBlade({a, b}), "photographs_disagree"));
}

}  // namespace
}  // namespace bladecurve
