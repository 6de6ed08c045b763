// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "curvefit/bands.h"
#include "curvefit/fit.h"
#include "fit_errors.h"
#include "simulated_edges.h"
#include "tests/degree.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

EdgePoints Simulate(const TrueScissors& scissors, const SimulatedPhoto& photo, unsigned seed = 1) {
  Noise noise(seed);
  return Photograph(scissors, photo, noise);
}

// The curve, its bands and its covariance are numbers, and the truth lies within 5 sigma.
void ExpectSane(const BladeFit& fit, const TrueScissors& scissors, double theta_rad) {
  const CurveBand band(fit.recommended);
  EXPECT_TRUE(fit.recommended.covariance.allFinite());
  const BladeCurve truth = TrueCurve(scissors);
  for (const double part : {0.3, 0.5, 0.8}) {
    const double x = part * scissors.u_end_mm * std::cos(theta_rad / 2);
    const double off =
        fit.recommended.curve.Eval(x, theta_rad).phi_mm - truth.Eval(x, theta_rad).phi_mm;
    const double sigma = band.At(x, theta_rad).phi_mm;
    EXPECT_TRUE(std::isfinite(off) && std::isfinite(sigma));
    EXPECT_LT(std::abs(off), 5 * sigma + 1e-9) << "x " << x;
  }
}

TEST(Extreme, FivePoints) {
  SimulatedPhoto photo;
  photo.points = 5;
  ExpectSane(FitBlade({Simulate(StraightScissors(), photo)}), StraightScissors(), photo.theta_rad);
}

TEST(Extreme, TwoPointsAreRefused) {
  EdgePoints edges = Simulate(StraightScissors(), {});
  edges.upper.resize(2);
  try {
    static_cast<void>(FitBlade({edges}));
    FAIL() << "two points gave a curve";
  } catch (const Refused& refused) {
    EXPECT_EQ(refused.reason(), Reason::kEdgeTooShort);
  }
}

TEST(Extreme, AMillionPoints) {
  SimulatedPhoto photo;
  photo.points = 1000000;
  photo.lower = false;
  ExpectSane(FitBlade({Simulate(StraightScissors(), photo)}), StraightScissors(), photo.theta_rad);
}

TEST(Extreme, AllOnALine) {
  SimulatedPhoto photo;
  photo.noise_scale = 0;
  ExpectSane(FitBlade({Simulate(StraightScissors(), photo)}), StraightScissors(), photo.theta_rad);
}

TEST(Extreme, DuplicatedPointsSayNoMore) {
  const EdgePoints edges = Simulate(CurvedScissors(), {});
  EdgePoints twice = edges;
  twice.upper.insert(twice.upper.end(), edges.upper.begin(), edges.upper.end());
  const BladeFit a = FitBlade({edges}), b = FitBlade({twice});
  EXPECT_EQ(a.recommended.covariance, b.recommended.covariance);
}

TEST(Extreme, OnePointManyTimesIsRefused) {
  EdgePoints edges = Simulate(CurvedScissors(), {});
  for (EdgePoint& p : edges.upper) p = edges.upper.front();
  EXPECT_THROW(static_cast<void>(FitBlade({edges})), Refused);
}

TEST(Extreme, HardlyOpenAndWideOpen) {
  for (const double theta : {2 * kDegree, 90 * kDegree}) {
    SimulatedPhoto photo;
    photo.theta_rad = theta;
    const BladeFit fit = FitBlade({Simulate(CurvedScissors(), photo)});
    ExpectSane(fit, CurvedScissors(), theta);
    EXPECT_GE(fit.recommended.curve.domain().theta_max_rad, theta);
  }
}

TEST(Extreme, HardlyOpenAndWideOpenTogether) {
  SimulatedPhoto narrow, wide;
  narrow.theta_rad = 2 * kDegree;
  wide.theta_rad = 90 * kDegree;
  const BladeFit fit =
      FitBlade({Simulate(CurvedScissors(), narrow, 1), Simulate(CurvedScissors(), wide, 2)});
  ExpectSane(fit, CurvedScissors(), wide.theta_rad);
  EXPECT_FALSE(Warned(fit, "photographs_disagree"));
}

// The same scissors, all lengths times a factor.
EdgePoints Times(EdgePoints edges, double factor) {
  for (auto* edge : {&edges.upper, &edges.lower}) {
    for (EdgePoint& p : *edge) p.point_mm *= factor, p.sigma_mm *= factor;
  }
  for (LocatedPoint* p : {&edges.pivot, &edges.upper_end, &edges.lower_end}) {
    p->point_mm *= factor;
    p->covariance_mm2 *= factor * factor;
  }
  return edges;
}

TEST(Extreme, ThreeMillimetresAndThreeMetres) {
  const EdgePoints edges = Simulate(CurvedScissors(), {});
  const BladeFit common = FitBlade({edges});
  for (const double factor : {3.0 / 60, 3000.0 / 60}) {
    const BladeFit fit = FitBlade({Times(edges, factor)});
    for (const double x : {15.0, 30.0, 45.0}) {
      EXPECT_NEAR(fit.recommended.curve.Eval(factor * x, 0.5).phi_mm / factor,
                  common.recommended.curve.Eval(x, 0.5).phi_mm,
                  1e-9);
    }
  }
}

TEST(Extreme, FarFromTheOriginOfItsFrame) {
  const EdgePoints edges = Simulate(CurvedScissors(), {});
  EdgePoints far = edges;
  const Eigen::Vector2d offset(1e6, -1e6);
  for (auto* edge : {&far.upper, &far.lower}) {
    for (EdgePoint& p : *edge) p.point_mm += offset;
  }
  for (LocatedPoint* p : {&far.pivot, &far.upper_end, &far.lower_end}) p->point_mm += offset;
  const BladeFit a = FitBlade({edges}), b = FitBlade({far});
  // Coordinates of 1e6 mm are rounded to 1e-10 mm.
  EXPECT_LT(LargestDifference(a.recommended.curve, b.recommended.curve, 0.5), 1e-7);
  EXPECT_LT((b.poses[0].pivot_mm - offset - a.poses[0].pivot_mm).norm(), 1e-7);
}

TEST(Extreme, SigmaFromNanometresTo1Metre) {
  for (const double sigma : {1e-9, 1e-6, 1e-3, 1.0}) {
    SimulatedPhoto photo;
    photo.sigma_mm = sigma;
    const BladeFit fit = FitBlade({Simulate(StraightScissors(), photo)});
    ExpectSane(fit, StraightScissors(), photo.theta_rad);
    EXPECT_GT(fit.recommended.poses[0].pivot_sigma_mm, 0.01) << "sigma of the edge " << sigma;
  }
  SimulatedPhoto vague;
  vague.noise_scale = 0;
  vague.sigma_mm = 1e3;
  EXPECT_THROW(static_cast<void>(FitBlade({Simulate(StraightScissors(), vague)})), Refused)
      << "such edges leave theta open";
  vague.theta_given = true;
  const BladeFit fit = FitBlade({Simulate(StraightScissors(), vague)});
  EXPECT_GT(CurveBand(fit.recommended).At(30, 0.5).phi_mm, 10);
}

TEST(Extreme, ALostTipLeavesNoCurveUnlessThetaIsGiven) {
  SimulatedPhoto photo;
  photo.lower = false;
  EdgePoints edges = Simulate(CurvedScissors(), photo);
  EXPECT_NO_THROW(static_cast<void>(FitBlade({edges})));
  edges.lower_end.covariance_mm2 = 20 * 20 * Eigen::Matrix2d::Identity();
  try {
    static_cast<void>(FitBlade({edges}));
    ADD_FAILURE() << "theta is known to a radian only";
  } catch (const Refused& refusal) {
    EXPECT_EQ(refusal.reason(), Reason::kFitFailed);
    EXPECT_NE(std::string(refusal.what()).find("theta is"), std::string::npos) << refusal.what();
  }
  edges.theta_given = true;
  EXPECT_NO_THROW(static_cast<void>(FitBlade({edges})));
}

// An edge whose last part is bent away, as by a shadow beside the tip, draws theta with it.
TEST(Extreme, ThetaIsAsUncertainAsTheFitMovedItFromTheEnds) {
  SimulatedPhoto photo;
  photo.noise_scale = 0;
  photo.sigma_mm = 0.005;
  photo.end_along_sigma_mm = 3;
  EdgePoints edges = Simulate(CurvedScissors(), photo);
  const double before = FitBlade({edges}).poses[0].theta_sigma_rad;
  for (EdgePoint& p : edges.upper) p.point_mm.y() -= 0.0005 * std::pow(p.point_mm.x() - 10, 2);
  const FittedPose pose = FitBlade({edges}).poses[0];
  const double moved = std::abs(pose.theta_rad - photo.theta_rad);
  EXPECT_GT(moved, 3 * before);
  EXPECT_GT(1.96 * pose.theta_sigma_rad, moved);
}

TEST(Extreme, KnotsWithoutDataAreNotPlaced) {
  EdgePoints edges = Simulate(CurvedScissors(), {});
  // A glint hid the middle of the edge.
  std::erase_if(edges.upper,
                [](const EdgePoint& p) { return p.point_mm.x() > 22 && p.point_mm.x() < 45; });
  FitOptions options;
  options.num_spans = 20;
  const BladeFit fit = FitBlade({edges}, options);
  EXPECT_TRUE(fit.recommended.covariance.allFinite());
  EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(CurvedScissors()), 0.5, 15, 20),
            0.3);
}

// Where little is seen, as before a tip, the smoothness of the curve says what it may do.
TEST(Extreme, BandsDoNotDependOnHowNumbersAreRounded) {
  constexpr double kRounding = 1e-12, kSame = 0.01;
  SimulatedPhoto photo;
  photo.seen_end_mm = 52;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    EdgePoints edges = Simulate(SplineScissors(3, {30, 45}), photo, seed);
    const FamilyFit fit = FitBlade({edges}).recommended;
    for (std::vector<EdgePoint>* edge : {&edges.upper, &edges.lower})
      for (EdgePoint& p : *edge) p.point_mm *= 1 + kRounding;
    const FamilyFit again = FitBlade({edges}).recommended;
    EXPECT_NEAR(again.finer->effective_coefficients, fit.finer->effective_coefficients, kSame);
    for (const double x : {20.0, 40.0, 50.0, 56.0}) {
      const double sigma = CurveBand(fit).At(x, 0.5).phi_x;
      EXPECT_NEAR(CurveBand(again).At(x, 0.5).phi_x, sigma, kSame * sigma) << seed << " at " << x;
    }
  }
}

TEST(Extreme, MoreKnotsThanPointsAreLimited) {
  SimulatedPhoto photo;
  photo.points = 8;
  FitOptions options;
  options.num_spans = 20;
  const FamilyFit fit = FitBlade({Simulate(CurvedScissors(), photo)}, options).recommended;
  EXPECT_LE(std::get<RigidSpline>(fit.curve.shape()).coefficients_mm.size(), 8u);
  EXPECT_FALSE(fit.limits.empty());
}

TEST(Extreme, NotANumberIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto expect_refused = [](const EdgePoints& edges, const char* what) {
    try {
      static_cast<void>(FitBlade({edges}));
      FAIL() << what << " gave a curve";
    } catch (const Refused& refused) {
      EXPECT_EQ(refused.reason(), Reason::kFitFailed);
      EXPECT_NE(std::string(refused.what()).find("finite"), std::string::npos) << refused.what();
    }
  };
  EdgePoints edges = Simulate(CurvedScissors(), {});
  edges.upper[17].point_mm.x() = nan;
  expect_refused(edges, "a point of NaN");
  edges = Simulate(CurvedScissors(), {});
  edges.lower[3].sigma_mm = infinity;
  expect_refused(edges, "an infinite sigma");
  edges = Simulate(CurvedScissors(), {});
  edges.pivot.point_mm.y() = infinity;
  expect_refused(edges, "an infinite pivot");
}

}  // namespace
}  // namespace bladecurve
