// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "curvefit/bands.h"
#include "curvefit/fit.h"
#include "fit_errors.h"
#include "simulated_edges.h"

namespace bladecurve {
namespace {

constexpr int kDraws = 500;

// What many draws of the same photographs give.
struct Tally {
  double chi2_per_freedom = 0;  // mean
  double covered = 0;        // part of (draw, x) at which the 95 % interval of phi holds the truth
  double slope_covered = 0;  // the same of phi_x
  double squares = 0;        // mean of (error/sigma)^2 of phi
  double pivot = 0, theta = 0;  // the same of the pose
};

Tally Draw(const TrueScissors& scissors, const std::vector<SimulatedPhoto>& photos, int draws) {
  const BladeCurve truth = TrueCurve(scissors);
  const double theta = photos.front().theta_rad;
  const std::array<double, 8> places = {16, 21, 26, 31, 36, 41, 46, 51};
  Tally tally;
  for (int draw = 0; draw < draws; ++draw) {
    Noise noise(1000 + draw);
    std::vector<EdgePoints> seen;
    for (const SimulatedPhoto& photo : photos) seen.push_back(Photograph(scissors, photo, noise));
    const FamilyFit fit = FitBlade(seen).recommended;
    const CurveBand band(fit);
    for (const double x : places) {
      const CurveSample found = fit.curve.Eval(x, theta), true_one = truth.Eval(x, theta);
      const CurveSigma sigma = band.At(x, theta);
      const double z = (found.phi_mm - true_one.phi_mm) / sigma.phi_mm;
      tally.covered += std::abs(z) < 1.96 ? 1 : 0;
      tally.slope_covered += std::abs(found.phi_x - true_one.phi_x) < 1.96 * sigma.phi_x ? 1 : 0;
      tally.squares += z * z;
    }
    const FittedPose& pose = fit.poses.front();
    tally.pivot += (pose.pivot_mm - photos.front().pivot_mm).squaredNorm() /
                   (2 * pose.pivot_sigma_mm * pose.pivot_sigma_mm);
    tally.theta += std::pow((pose.theta_rad - theta) / pose.theta_sigma_rad, 2);
    tally.chi2_per_freedom += fit.residual_tests.chi2_per_freedom;
  }
  tally.covered /= draws * static_cast<double>(places.size());
  tally.slope_covered /= draws * static_cast<double>(places.size());
  tally.squares /= draws * static_cast<double>(places.size());
  tally.pivot /= draws;
  tally.theta /= draws;
  tally.chi2_per_freedom /= draws;
  return tally;
}

void ExpectHonest(const Tally& tally) {
  EXPECT_GT(tally.chi2_per_freedom, 0.9);
  EXPECT_LT(tally.chi2_per_freedom, 1.1);
  EXPECT_GT(tally.covered, 0.93);
  EXPECT_LT(tally.covered, 0.97);
  EXPECT_GT(tally.slope_covered, 0.93);
  EXPECT_LT(tally.slope_covered, 0.97);
  // Errors of one draw go together along the edge: 500 draws know their mean square to 6 %; 3 of
  // these sigmas.
  EXPECT_NEAR(tally.squares, 1, 0.19);
  EXPECT_NEAR(tally.pivot, 1, 0.19);
  EXPECT_NEAR(tally.theta, 1, 0.19);
}

TEST(FitStatistics, StatedSigmasHoldForOnePhotograph) {
  ExpectHonest(Draw(CurvedScissors(), {SimulatedPhoto{}}, kDraws));
}

TEST(FitStatistics, StatedSigmasHoldWithSystematicErrorsAndCorrelatedNeighbours) {
  SimulatedPhoto photo;
  photo.scale_sigma = 0.002;
  photo.offset_sigma_mm = 0.02;
  photo.correlation_length_mm = 0.5;
  photo.pivot_mm = {0.3, -0.2};
  photo.axis_rad = 0.05;
  // The first 500 draws alone lie three sigmas high in theta; 4000 say 1.02.
  ExpectHonest(Draw(CurvedScissors(), {photo}, 3 * kDraws));
}

// An offset that both edges share moves both distal ends, and theta by twice as much.
TEST(FitStatistics, StatedSigmasHoldWhereAnOffsetOutweighsTheNoise) {
  SimulatedPhoto photo;
  photo.offset_sigma_mm = 0.2;
  photo.points = 200;
  ExpectHonest(Draw(CurvedScissors(), {photo}, 4 * kDraws));
}

TEST(FitStatistics, StatedSigmasHoldForThreePhotographs) {
  std::vector<SimulatedPhoto> photos(3);
  photos[1].theta_rad = 0.15;
  photos[2].theta_rad = 1.0;
  for (SimulatedPhoto& photo : photos) photo.points = 200;
  ExpectHonest(Draw(CurvedScissors(), photos, kDraws));
}

// Knots chosen from the same points look better than they are: the bands have to know.
TEST(FitStatistics, StatedSigmasHoldForWavyEdgesWhoseKnotsAreChosen) {
  ExpectHonest(Draw(SplineScissors(3, {20, 30, 45}), {SimulatedPhoto{}}, kDraws));
}

// What edges cannot say: how far along the symmetry line the pivot is. With knots between the
// pieces of the spline, which must not tie it to the edge.
TEST(FitStatistics, StatedSigmasHoldWhereTheEdgeIsLostBeforeTheTip) {
  SimulatedPhoto photo;
  photo.seen_end_mm = 46;
  const Tally tally = Draw(CurvedScissors(), {photo}, kDraws);
  for (const double covered : {tally.covered, tally.slope_covered}) {
    EXPECT_GT(covered, 0.93);
    EXPECT_LT(covered, 0.98);  // 0.9995 of the slopes once, when rounding chose the band
  }
}

TEST(FitStatistics, PivotThatIsHardlySeenStaysAsUncertain) {
  SimulatedPhoto photo;
  photo.pivot_sigma_mm = 0.3;
  photo.pivot_along_sigma_mm = 3;
  photo.points = 200;
  const TrueScissors scissors = SplineScissors(3, {30, 42});
  double pivot = 0, theta = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Noise noise(9000 + draw);
    const EdgePoints seen = Photograph(scissors, photo, noise);
    const FittedPose pose = FitBlade({seen}).poses.front();
    const double said = pose.pivot_covariance_mm2(0, 0) / seen.pivot.covariance_mm2(0, 0);
    ASSERT_GT(said, 0.9) << "the fit claims to have found the pivot, draw " << draw;
    constexpr double kHalfWidth = 1.96;  // of the 95 % interval, in sigma
    const double off_mm = pose.pivot_mm.x() - photo.pivot_mm.x();
    pivot += std::abs(off_mm) < kHalfWidth * std::sqrt(pose.pivot_covariance_mm2(0, 0));
    theta += std::abs(pose.theta_rad - photo.theta_rad) < kHalfWidth * pose.theta_sigma_rad;
  }
  EXPECT_GT(pivot / kDraws, 0.93);
  EXPECT_LT(pivot / kDraws, 0.97);
  EXPECT_GT(theta / kDraws, 0.93);
  EXPECT_LT(theta / kDraws, 0.97);
}

// Several angles do say it: blades turn about the pivot, wherever none of the photographs saw it.
TEST(FitStatistics, ThreePhotographsFindThePivotThatNoneSees) {
  std::vector<SimulatedPhoto> photos(3);
  photos[1].theta_rad = 0.2;
  photos[2].theta_rad = 0.9;
  for (SimulatedPhoto& photo : photos) {
    photo.points = 100;
    photo.pivot_sigma_mm = 0.3;
    photo.pivot_along_sigma_mm = 3;
  }
  constexpr int kFew = 200;  // the coverage is then known to 1.5 %
  double covered = 0, squares = 0;
  for (int draw = 0; draw < kFew; ++draw) {
    Noise noise(11000 + draw);
    std::vector<EdgePoints> seen;
    for (const SimulatedPhoto& photo : photos) {
      seen.push_back(Photograph(CurvedScissors(), photo, noise));
    }
    const FittedPose pose = FitBlade(seen).poses.front();
    const double off_mm = pose.pivot_mm.x() - photos[0].pivot_mm.x();
    covered += std::abs(off_mm) < 1.96 * std::sqrt(pose.pivot_covariance_mm2(0, 0));
    squares += off_mm * off_mm;
  }
  EXPECT_LT(std::sqrt(squares / kFew), 0.3) << "ten times better than the photographs say";
  EXPECT_GT(covered / kFew, 0.91);
  EXPECT_LT(covered / kFew, 0.99);
}

// sigma of phi in the middle of the edge.
double SigmaOf(const std::vector<EdgePoints>& photos) {
  return CurveBand(FitBlade(photos).recommended).At(35, 0.5).phi_mm;
}

TEST(FitStatistics, ThreePhotographsBeatOneAsTheBoundPredicts) {
  // At one angle three equal photographs hold three times the information.
  Noise noise(3);
  std::vector<EdgePoints> photos;
  for (int i = 0; i < 3; ++i) photos.push_back(Photograph(CurvedScissors(), {}, noise));
  EXPECT_NEAR(SigmaOf({photos[0]}) / SigmaOf(photos), std::sqrt(3.0), 0.02 * std::sqrt(3.0));
}

TEST(FitStatistics, ThreeAnglesHoldTheInformationOfEachAndMore) {
  Noise noise(6);
  std::vector<EdgePoints> photos;
  double information = 0;
  for (const double theta : {0.15, 0.5, 1.0}) {
    SimulatedPhoto photo;
    photo.theta_rad = theta;
    photos.push_back(Photograph(CurvedScissors(), photo, noise));
    information += std::pow(SigmaOf({photos.back()}), -2);
  }
  // Poses differ, so nothing is shared but the shape: the information adds up. Different angles
  // also fix the pivots.
  constexpr double kLinear = 1.02;  // sigmas of different draws differ by this much
  EXPECT_LT(SigmaOf(photos), kLinear / std::sqrt(information));
}

TEST(FitStatistics, ErrorFallsAsTheRootOfThePoints) {
  SimulatedPhoto few, many;
  for (SimulatedPhoto* photo : {&few, &many}) {
    photo->pivot_sigma_mm = photo->end_along_sigma_mm = 1e-4;
    photo->lower = false;
  }
  few.points = 300;
  many.points = 2700;
  Noise noise(4);
  const double ratio = SigmaOf({Photograph(CurvedScissors(), few, noise)}) /
                       SigmaOf({Photograph(CurvedScissors(), many, noise)});
  EXPECT_NEAR(ratio, 3, 0.1);
}

// Slope of the best line through all points of both edges, pose known: what cannot be beaten. Each
// edge is mirrored onto the upper one.
double BestSlope(const EdgePoints& edges) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto* edge : {&edges.upper, &edges.lower}) {
    const double side = edge == &edges.upper ? 1 : -1;
    for (const EdgePoint& p : *edge) {
      const Eigen::Vector2d q(p.point_mm.x(), side * p.point_mm.y());
      n += 1, x += q.x(), y += q.y(), xx += q.x() * q.x(), xy += q.x() * q.y();
    }
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

TEST(FitStatistics, TaperedFormIsEfficient) {
  SimulatedPhoto photo;
  photo.theta_given = true;
  photo.theta_sigma_rad = photo.pivot_sigma_mm = photo.end_along_sigma_mm = 1e-7;
  FitOptions options;
  options.family = Family::kTaperedRectangle;
  const TrueScissors scissors = TaperedScissors();
  const double truth = TrueCurve(scissors).Eval(30, photo.theta_rad).phi_x;
  double fitted = 0, best = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Noise noise(5000 + draw);
    const EdgePoints edges = Photograph(scissors, photo, noise);
    const BladeFit fit = FitBlade({edges}, options);
    fitted += std::pow(fit.recommended.curve.Eval(30, photo.theta_rad).phi_x - truth, 2);
    best += std::pow(BestSlope(edges) - truth, 2);
  }
  EXPECT_GT(best / fitted, 0.95) << "variance of the best line over ours";
}

}  // namespace
}  // namespace bladecurve
