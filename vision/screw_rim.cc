// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_rim.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "vision/robust_statistics.h"
#include "vision/screw_profiles.h"

namespace bladecurve {
namespace {

using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr double kShrink = 0.8;            // of the profiles from one iteration to the next
constexpr double kTukeySigmas = 4.0;       // beyond: something else than the rim
constexpr double kLeastScatterPx = 0.02;   // keeps the biweight open on perfect pictures
constexpr double kLeastCorrelation = 0.2;  // profiles less alike the common one have no weight
constexpr double kRimCorrelation = 0.6;    // profiles more alike count as rim seen
constexpr double kRimLeastStrength = 0.1;  // of the median: fainter is noise that happens to fit
// How near to the ellipse a rim point must be, of the radius and at least.
constexpr double kRimRelativeWidth = 0.06, kRimLeastWidthPx = 0.5;
// F(2, 14) over chi^2(2)/2 at 95 %: so few blocks scatter themselves.
constexpr double kFewBlocks = 1.25;
constexpr std::size_t kBlocks = 24;       // of the rim, taken as independent in the covariance
constexpr double kLeastSlopeShare = 0.3;  // a rim of outliers only: the scatter means nothing then
constexpr int kReweightings = 4;
constexpr double kNormalMad = 1.4826;  // standard deviation over median deviation, normal law
// Semi-axes over the radius begun with; beyond, the fit ran away to something else.
constexpr double kLeastOfStart = 0.5, kMostOfStart = 1.6;
// Weight of "no change", in profiles: keeps the equations solvable where hardly any rim is seen.
const Vector5d kDamping(1e-6, 1e-6, 1e-2, 1e-2, 1e-2);

// A robust fit of a small change of the ellipse to the shifts.
struct Update {
  Vector5d change = Vector5d::Zero();  // of center x, y, shape xx, xy, yy
  std::vector<double> residual_px, weight;
  Eigen::Matrix2d center_covariance = Eigen::Matrix2d::Identity();
};

// What a profile may say at most: little where it looks unlike the rim or is faint.
double PriorWeight(const RimMatch& match, double typical_amplitude) {
  const double likeness = std::max(0.0, match.correlation - kLeastCorrelation);
  const double strength = match.amplitude / typical_amplitude;
  return likeness * std::min(1.0, strength * strength);
}

double Biweight(double z) { return std::abs(z) < 1 ? (1 - z * z) * (1 - z * z) : 0; }
// d(z w(z))/dz: what a residual still adds to the estimate when it grows.
double BiweightSlope(double z) { return std::abs(z) < 1 ? (1 - z * z) * (1 - 5 * z * z) : 0; }

// Residuals near each other on the rim are correlated (a glint, the grain of the ground), so the
// scatter is taken from the scores of whole blocks, g_b = sum over the block of w J r, and of
// neighbouring blocks together (Newey and West 1987):
// A^-1 (sum_b g_b g_b^T + (g_b g_{b+1}^T + g_{b+1} g_b^T)/2) A^-1. The fit has taken 5 degrees of
// freedom out of the B blocks, which costs B/(B - 5 (1 + cos(2 pi/B))). The slope share squared is
// due to any M-estimator (Huber 1981, 6.3).
Eigen::Matrix2d CenterCovariance(const RimProfiles& profiles,
                                 const Update& update,
                                 const Matrix5d& normal,
                                 double slope_share) {
  const std::size_t count = update.weight.size();
  std::vector<Vector5d> scores(kBlocks, Vector5d::Zero());
  for (std::size_t i = 0; i < count; ++i) {
    scores[i * kBlocks / count] += update.weight[i] * update.residual_px[i] * profiles.jacobian[i];
  }
  Matrix5d scatter = Matrix5d::Zero();
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const Vector5d& own = scores[block];
    const Vector5d& next = scores[(block + 1) % kBlocks];
    scatter += own * own.transpose() + 0.5 * (own * next.transpose() + next * own.transpose());
  }
  const Matrix5d inverse = normal.ldlt().solve(Matrix5d::Identity());
  const double lost = 5 * (1 + std::cos(2 * std::numbers::pi / kBlocks));
  const double factor = kFewBlocks * kBlocks / (kBlocks - lost) / (slope_share * slope_share);
  return factor * (inverse * scatter * inverse).topLeftCorner<2, 2>();
}

// Normal equations of what is known beforehand: that the semi-axes part by no more than
// flattening_px, as (shape_xx - shape_yy) / 2 and shape_xy say.
struct Expectation {
  Matrix5d normal = Matrix5d::Zero();  // to be multiplied by the variance of an independent profile
  Vector5d right = Vector5d::Zero();
};

Expectation ExpectRound(const RimEllipse& rim, double flattening_px) {
  Expectation round;
  if (!(flattening_px > 0)) return round;
  const Eigen::Matrix2d& shape = rim.shape;
  Vector5d difference, shear;
  difference << 0, 0, 0.5, 0, -0.5;
  shear << 0, 0, 0, 1, 0;
  const double weight = 1 / (flattening_px * flattening_px);
  round.normal = weight * (difference * difference.transpose() + shear * shear.transpose());
  round.right = -weight * (0.5 * (shape(0, 0) - shape(1, 1)) * difference + shape(0, 1) * shear);
  return round;
}

Update FitShifts(const RimProfiles& profiles,
                 const std::vector<RimMatch>& matches,
                 const Expectation& expected) {
  const std::size_t count = matches.size();
  std::vector<double> amplitudes(count), residuals(count);
  for (std::size_t i = 0; i < count; ++i) amplitudes[i] = std::abs(matches[i].amplitude);
  const double typical = Median(amplitudes) + 1e-12;
  Update update;
  update.residual_px.resize(count);
  update.weight.resize(count);
  Matrix5d normal;
  double scatter_px = profiles.t[profiles.t.size() - 1] / 2;
  for (int round = 0; round < kReweightings; ++round) {
    normal = kDamping.asDiagonal();
    Vector5d right = Vector5d::Zero();
    if (round + 1 == kReweightings) {
      // Only now, as the scatter about an ellipse held round would say that it may be held so.
      // Neighbouring profiles err alike: a block of them is one observation.
      const double variance_px2 = scatter_px * scatter_px * static_cast<double>(count) / kBlocks;
      normal += variance_px2 * expected.normal;
      right = variance_px2 * expected.right;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double residual = matches[i].shift_px - profiles.jacobian[i].dot(update.change);
      update.weight[i] =
          PriorWeight(matches[i], typical) * Biweight(residual / (kTukeySigmas * scatter_px));
      normal += update.weight[i] * profiles.jacobian[i] * profiles.jacobian[i].transpose();
      right += update.weight[i] * matches[i].shift_px * profiles.jacobian[i];
    }
    update.change = normal.ldlt().solve(right);
    for (std::size_t i = 0; i < count; ++i) {
      update.residual_px[i] = matches[i].shift_px - profiles.jacobian[i].dot(update.change);
      residuals[i] = std::abs(update.residual_px[i]);
    }
    scatter_px = std::clamp(kNormalMad * Median(residuals), kLeastScatterPx, scatter_px);
  }
  double slopes = 0, weights = 1e-12;
  for (std::size_t i = 0; i < count; ++i) {
    const double prior = PriorWeight(matches[i], typical);
    const double z = update.residual_px[i] / (kTukeySigmas * scatter_px);
    slopes += prior * BiweightSlope(z);
    weights += prior * Biweight(z);
  }
  const double slope_share = std::max(slopes / weights, kLeastSlopeShare);
  update.center_covariance = CenterCovariance(profiles, update, normal, slope_share);
  return update;
}

void RateSupport(const std::vector<RimMatch>& matches,
                 const Update& update,
                 double radius,
                 RimFit& fit) {
  const double width = std::max(kRimRelativeWidth * radius, kRimLeastWidthPx);
  const std::size_t count = matches.size(), third = count / 3;
  std::vector<int> seen(count);
  std::vector<double> strengths(count);
  for (std::size_t i = 0; i < count; ++i) strengths[i] = std::abs(matches[i].strength);
  const double faint = kRimLeastStrength * Median(strengths);
  for (std::size_t i = 0; i < count; ++i) {
    seen[i] = matches[i].correlation > kRimCorrelation && matches[i].strength > faint &&
              std::abs(update.residual_px[i]) < width;
  }
  int in_third =
      std::accumulate(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(third), 0);
  int least = in_third;
  for (std::size_t i = 0; i < count; ++i) {
    in_third += seen[(i + third) % count] - seen[i];
    least = std::min(least, in_third);
  }
  fit.support = std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(count);
  fit.third_support = static_cast<double>(least) / static_cast<double>(third);
}

RimEllipse Changed(const RimEllipse& rim, const Vector5d& change) {
  RimEllipse result = rim;
  result.center += change.head<2>();
  result.shape(0, 0) += change[2];
  result.shape(0, 1) += change[3];
  result.shape(1, 0) += change[3];
  result.shape(1, 1) += change[4];
  return result;
}

}  // namespace

std::optional<RimFit> FitRim(const cv::Mat& picture,
                             const RimEllipse& start,
                             const RimFitOptions& options) {
  const double start_radius = start.MeanRadius();
  RimFit fit{start, Eigen::Matrix2d::Identity()};
  double half_px = options.first_half_px;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    const bool settling = 2 * iteration < options.iterations;  // half the profiles will do
    const RimProfiles profiles =
        SampleProfiles(picture,
                       fit.rim,
                       {half_px, options.most_profiles / (settling ? 2 : 1), options.flat_window});
    const std::optional<std::vector<RimMatch>> matches = MatchProfiles(profiles);
    if (!matches) return std::nullopt;
    Update update = FitShifts(
        profiles, *matches, ExpectRound(fit.rim, options.expected_flattening * start_radius));
    const double most_change = half_px / 2;  // what lies further off has not been seen
    const double change = update.change.head<2>().norm();
    if (change > most_change) update.change *= most_change / change;
    fit.rim = Changed(fit.rim, update.change);
    const Eigen::Vector2d axes = fit.rim.SemiAxes();
    if (!(axes[0] > kLeastOfStart * start_radius && axes[1] < kMostOfStart * start_radius)) {
      return std::nullopt;
    }
    fit.center_covariance = update.center_covariance;
    RateSupport(*matches, update, start_radius, fit);
    if (!settling && fit.support < options.hopeless_support) return std::nullopt;
    if (!settling && half_px <= options.last_half_px && update.change.norm() < options.converged_px)
      break;
    half_px = std::max(options.last_half_px, kShrink * half_px);
  }
  return fit;
}

}  // namespace bladecurve
