// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit_errors.h"
#include "simulated_edges.h"

namespace bladecurve {
namespace {

constexpr double kExact = 1e-9;           // mm; exact data leave rounding only
constexpr double kSettled = 1e-5 * 0.02;  // mm; of noisy data, what the minimiser leaves of a sigma

EdgePoints Exact(const TrueScissors& scissors, SimulatedPhoto photo = {}) {
  photo.noise_scale = 0;
  Noise noise(1);
  return Photograph(scissors, photo, noise);
}

std::vector<EdgePoints> AtAngles(const TrueScissors& scissors,
                                 SimulatedPhoto photo,
                                 unsigned seed) {
  Noise noise(seed);
  std::vector<EdgePoints> photos;
  for (const double theta : {0.15, 0.5, 1.0}) {
    photo.theta_rad = theta;
    photos.push_back(Photograph(scissors, photo, noise));
  }
  return photos;
}

FitOptions Spline(int degree, std::vector<double> knots_mm) {
  FitOptions options;
  options.degree = degree;
  options.knots_mm = std::move(knots_mm);
  return options;
}

class SplineDegree : public testing::TestWithParam<int> {};

TEST_P(SplineDegree, ExactSplineIsRecovered) {
  const std::vector<double> knots =
      GetParam() == 1 ? std::vector<double>{} : std::vector<double>{25, 40};
  const TrueScissors scissors = SplineScissors(GetParam(), knots);
  const BladeFit fit = FitBlade({Exact(scissors)}, Spline(GetParam(), knots));
  for (const double theta : {0.0, 0.5, 1.0}) {
    EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(scissors), theta), kExact)
        << theta;
  }
}
INSTANTIATE_TEST_SUITE_P(Degrees, SplineDegree, testing::Range(1, 6));

TEST(FitBlade, ExactTaperedFormIsRecoveredAtAllAngles) {
  SimulatedPhoto photo;
  photo.theta_given =
      true;  // the paper's form turns its ends by less than theta: theta must be known
  photo.noise_scale = 0;
  const TrueScissors scissors = TaperedScissors();
  const BladeFit fit = FitBlade(AtAngles(scissors, photo, 1));
  ASSERT_TRUE(std::holds_alternative<TaperedRectangle>(fit.recommended.curve.shape()))
      << fit.why_recommended;
  EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(scissors), 0.3), kExact);
  EXPECT_NEAR(fit.gain.gain, 0.5, 1e-9);
}

TEST(FitBlade, ExactGainOfTheTaperedFormIsRecovered) {
  SimulatedPhoto photo;
  photo.theta_given = true;
  photo.noise_scale = 0;
  FitOptions options;
  options.family = Family::kTaperedRectangle;
  options.gain = std::nullopt;
  for (const double gain : {0.3, 0.8, 1.0}) {
    const TrueScissors scissors = TaperedScissors(gain);
    const BladeFit fit = FitBlade(AtAngles(scissors, photo, 1), options);
    EXPECT_NEAR(std::get<TaperedRectangle>(fit.recommended.curve.shape()).gain, gain, 1e-9);
    EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(scissors), 0.3), kExact) << gain;
  }
}

TEST(FitBlade, ExactSplineIsRecoveredFromSeveralAngles) {
  SimulatedPhoto photo;
  photo.noise_scale = 0;
  const TrueScissors scissors = SplineScissors(3, {25, 40});
  const BladeFit fit = FitBlade(AtAngles(scissors, photo, 1), Spline(3, {25, 40}));
  EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(scissors), 0.5), kExact);
}

TEST(FitBlade, OnePhotographFixesTheTaperedEdgeAtItsAngle) {
  const TrueScissors scissors = StraightScissors();
  const BladeFit fit = FitBlade({Exact(scissors)});
  const FamilyFit& tapered = TaperedOf(fit);
  EXPECT_LT(LargestDifference(tapered.curve, TrueCurve(scissors), 0.5), kExact);
  EXPECT_EQ(std::get<TaperedRectangle>(tapered.curve.shape()).gain, 0.5);
  EXPECT_TRUE(std::isnan(fit.gain.gain));
}

TEST(FitBlade, FreeGainOfOnePhotographIsReportedAsUndetermined) {
  FitOptions options;
  options.gain = std::nullopt;
  const FamilyFit tapered = TaperedOf(FitBlade({Exact(StraightScissors())}, options));
  ASSERT_EQ(tapered.undetermined.size(), 1u);
  EXPECT_NE(tapered.undetermined[0].text.find("gain"), std::string::npos);
  EXPECT_EQ(std::get<TaperedRectangle>(tapered.curve.shape()).gain, 0.5);
  EXPECT_EQ(tapered.parameter_names.size(), 2u);
}

TEST(FitBlade, RigidTurnHasAGainOfAboutOne) {
  // d/dtheta of tan(theta/2 + inclination) against tan(theta/2): 1/cos^2 of 7 deg and more.
  const BladeFit fit = FitBlade(AtAngles(StraightScissors(), {}, 3));
  EXPECT_GT(fit.gain.gain, 0.95);
  EXPECT_LT(fit.gain.gain, 1.3);
  EXPECT_TRUE(std::holds_alternative<RigidSpline>(fit.recommended.curve.shape()));
}

TEST(FitBlade, StraightEdgeIsALineOfTwoCoefficients) {
  Noise noise(5);
  const BladeFit fit = FitBlade({Photograph(StraightScissors(), {}, noise)});
  const auto& spline = std::get<RigidSpline>(fit.recommended.curve.shape());
  EXPECT_EQ(spline.degree, 1);
  EXPECT_EQ(spline.coefficients_mm.size(), 2u);
}

// One photograph cannot say how the edge turns: that is an assumption to know of, no doubt about
// the photograph.
TEST(FitBlade, FamiliesPartNearClosing) {
  const BladeFit fit = FitBlade({Exact(StraightScissors())});
  EXPECT_TRUE(Noted(fit, "families_part"));
  EXPECT_TRUE(fit.warnings.empty());
  EXPECT_GT(fit.largest_difference_torque, 0.3);
  EXPECT_LT(fit.difference.near_closing_theta_rad, 0.3);
  EXPECT_LT(fit.difference.photographed_mm, 1e-6) << "at its own angle they agree";
}

TEST(FitBlade, FamiliesThatSeveralAnglesTellApartAreNoDoubt) {
  const BladeFit fit = FitBlade(AtAngles(StraightScissors(), {}, 3));
  EXPECT_GT(fit.difference.photographed_torque, 0.1);
  EXPECT_FALSE(Warned(fit, "families_part"));
  EXPECT_TRUE(Noted(fit, "families_part"));
}

TEST(FitBlade, FamilyThatTheAnglesContradictIsReviewed) {
  FitOptions options;
  options.family = Family::kTaperedRectangle;
  const BladeFit fit = FitBlade(AtAngles(StraightScissors(), {}, 3), options);
  EXPECT_TRUE(Warned(fit, "families_part"));
}

TEST(FitBlade, FamiliesThatCloseAnglesCannotTellApartAreReviewed) {
  SimulatedPhoto vague;
  vague.points = 20;
  vague.sigma_mm = vague.pivot_sigma_mm = 1;
  vague.end_along_sigma_mm = 2;
  Noise noise(3);
  std::vector<EdgePoints> photos;
  for (const double theta : {0.45, 0.55}) {
    vague.theta_rad = theta;
    photos.push_back(Photograph(StraightScissors(), vague, noise));
  }
  const BladeFit fit = FitBlade(photos);
  EXPECT_GT(fit.difference.photographed_torque, 0.1);
  EXPECT_TRUE(Warned(fit, "families_part"));
}

TEST(FitBlade, GivenThetaIsTheThetaOfTheCurve) {
  SimulatedPhoto photo;
  photo.theta_given = true;
  EdgePoints edges = Exact(CurvedScissors(), photo);
  const double zero = 0.05;  // an encoder that starts elsewhere
  edges.theta_rad += zero;
  const BladeFit fit = FitBlade({edges});
  EXPECT_NEAR(fit.poses[0].theta_rad, 0.5 + zero, 1e-6);
  EXPECT_EQ(fit.theta_definition, "given");
  // The curve at the user's theta is the edge as it was seen, but for what a cubic that is turned
  // by zero/2 is no cubic over u any more.
  const BladeCurve truth = TrueCurve(CurvedScissors());
  for (const double x : {15.0, 30.0, 45.0}) {
    EXPECT_NEAR(fit.recommended.curve.Eval(x, 0.5 + zero).phi_mm, truth.Eval(x, 0.5).phi_mm, 1e-4);
  }
  EXPECT_TRUE(Warned(fit, "theta_given_differs"));
}

TEST(FitBlade, MovedAndTurnedPhotographGivesTheSameCurve) {
  Noise noise(7);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  EdgePoints moved = edges;
  const Eigen::Rotation2Dd turn(0.7);
  const Eigen::Vector2d shift(31, -12);
  const auto move = [&](Eigen::Vector2d& p) { p = turn * p + shift; };
  for (auto* edge : {&moved.upper, &moved.lower}) {
    for (EdgePoint& p : *edge) move(p.point_mm), p.normal = turn * p.normal;
  }
  for (LocatedPoint* p : {&moved.pivot, &moved.upper_end, &moved.lower_end}) {
    move(p->point_mm);
    p->covariance_mm2 = turn * p->covariance_mm2 * turn.inverse();
  }
  const BladeFit a = FitBlade({edges}), b = FitBlade({moved});
  EXPECT_LT(LargestDifference(a.recommended.curve, b.recommended.curve, 0.5), kExact);
  EXPECT_NEAR(b.poses[0].axis_rad - a.poses[0].axis_rad, 0.7, 1e-9);
}

TEST(FitBlade, LargerScissorsGiveTheLargerCurve) {
  Noise noise(8);
  for (const auto& [edges, bound_mm] :
       {std::pair(Exact(CurvedScissors()), kExact),
        std::pair(Photograph(CurvedScissors(), {}, noise), kSettled)}) {
    EdgePoints large = edges;
    constexpr double kFactor = 3;
    for (auto* edge : {&large.upper, &large.lower}) {
      for (EdgePoint& p : *edge) p.point_mm *= kFactor, p.sigma_mm *= kFactor;
    }
    for (LocatedPoint* p : {&large.pivot, &large.upper_end, &large.lower_end}) {
      p->point_mm *= kFactor;
      p->covariance_mm2 *= kFactor * kFactor;
    }
    const BladeFit a = FitBlade({edges}), b = FitBlade({large});
    for (const double x : {15.0, 30.0, 45.0}) {
      EXPECT_NEAR(b.recommended.curve.Eval(kFactor * x, 0.5).phi_mm,
                  kFactor * a.recommended.curve.Eval(x, 0.5).phi_mm,
                  kFactor * bound_mm);
    }
  }
}

// A fit that had the ends lie off across the rays, not across the edges, explained 0.05 mm
// between ends and edges by edges 1.5 mm off, and turned the blades by three degrees.
TEST(FitBlade, EdgesThatMayLieFarOffAreNotMovedToMeetTheEnds) {
  constexpr double kOutMm = 0.05;
  SimulatedPhoto photo;
  photo.offset_sigma_mm = 1;
  EdgePoints edges = Exact(CurvedScissors(), photo);
  const auto angle = [&] {
    const Eigen::Vector2d up = edges.upper_end.point_mm - edges.pivot.point_mm;
    const Eigen::Vector2d low = edges.lower_end.point_mm - edges.pivot.point_mm;
    return std::atan2(up.y(), up.x()) - std::atan2(low.y(), low.x());
  };
  edges.upper_end.point_mm += kOutMm * edges.upper.back().normal;
  edges.lower_end.point_mm += kOutMm * edges.lower.back().normal;
  const BladeFit fit = FitBlade({edges});
  EXPECT_NEAR(fit.recommended.poses[0].theta_rad, angle(), 0.004);
}

TEST(FitBlade, OrderOfPointsDoesNotMatter) {
  Noise noise(9);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  EdgePoints shuffled = edges;
  std::mt19937 random(3);
  for (size_t i = shuffled.upper.size(); i > 1; --i) {
    std::swap(shuffled.upper[i - 1], shuffled.upper[random() % i]);
  }
  const BladeFit a = FitBlade({edges}), b = FitBlade({shuffled});
  EXPECT_LT(LargestDifference(a.recommended.curve, b.recommended.curve, 0.5), kExact);
}

TEST(FitBlade, SameInputGivesTheSameBits) {
  const std::vector<EdgePoints> photos = AtAngles(CurvedScissors(), {}, 11);
  FitOptions many;
  many.num_threads = 8;
  const BladeFit a = FitBlade(photos), b = FitBlade(photos, many);
  const auto& sa = std::get<RigidSpline>(a.recommended.curve.shape());
  const auto& sb = std::get<RigidSpline>(b.recommended.curve.shape());
  EXPECT_EQ(sa.coefficients_mm, sb.coefficients_mm);
  EXPECT_EQ(sa.knots_mm, sb.knots_mm);
  EXPECT_EQ(a.recommended.covariance, b.recommended.covariance);
}

TEST(FitBlade, ImpossibleOptionsNameTheField) {
  const std::vector<EdgePoints> photos = {Exact(StraightScissors())};
  FitOptions options;
  options.degree = 6;
  EXPECT_THROW(static_cast<void>(FitBlade(photos, options)), std::invalid_argument);
  options = {};
  options.loss = "l1";
  EXPECT_THROW(static_cast<void>(FitBlade(photos, options)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(FitBlade({}, {})), std::invalid_argument);
}

TEST(FitBlade, SaysWhatTheSolverDid) {
  Noise noise(12);
  const FamilyFit fit = FitBlade({Photograph(CurvedScissors(), {}, noise)}).recommended;
  EXPECT_TRUE(fit.converged) << fit.termination;
  EXPECT_NE(fit.termination.find("converged"), std::string::npos);
  EXPECT_EQ(fit.trace.size(), static_cast<size_t>(fit.iterations));
  EXPECT_EQ(fit.rank, fit.num_parameters);
  EXPECT_LT(std::abs(fit.residual_tests.runs_z), 4);
  EXPECT_GT(fit.influence.largest_leverage, 0);
  EXPECT_LT(fit.influence.largest_cook, 1);
  EXPECT_EQ(fit.covariance.rows(), static_cast<Eigen::Index>(fit.parameter_names.size()));
}

TEST(FitBlade, EveryLossFitsGoodPointsAlike) {
  Noise noise(13);
  const EdgePoints edges = Photograph(CurvedScissors(), {}, noise);
  for (const char* loss : {"none", "huber", "cauchy", "tukey"}) {
    FitOptions options;
    options.loss = loss;
    const BladeFit fit = FitBlade({edges}, options);
    EXPECT_LT(LargestDifference(fit.recommended.curve, TrueCurve(CurvedScissors()), 0.5), 0.15)
        << loss;
  }
}

}  // namespace
}  // namespace bladecurve
