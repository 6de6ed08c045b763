// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_shifts.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kLeastScatterPx = 0.02;   // keeps the biweight open on perfect pictures
constexpr double kLeastCorrelation = 0.2;  // profiles less alike the common one have no weight
// So few blocks scatter themselves: F(2, 14) over chi^2(2)/2 at 95 % is 1.25. And weights learnt
// from the same profiles flatter them by some 15 %.
constexpr double kFewBlocks = 1.45;
constexpr Index kBlocks = 24;             // of the rim, taken as independent in the covariance
constexpr double kLeastSlopeShare = 0.3;  // a rim of outliers only: the scatter means nothing then
constexpr int kReweightings = 4;
// Weight of "no change", in profiles: keeps the equations solvable where hardly any rim is seen.
const Vector5d kDamping(1e-6, 1e-6, 1e-2, 1e-2, 1e-2);

struct Shifts {
  Eigen::VectorXd px;
  ArrayXd prior;    // weight at most: little where a profile looks unlike the rim or is faint
  ArrayXd evening;  // turns residuals into such of even scatter
};

Shifts ShiftsOf(const std::vector<RimMatch>& matches) {
  std::vector<double> amplitudes;
  for (const RimMatch& match : matches) amplitudes.push_back(std::abs(match.amplitude));
  const double typical = Median(std::move(amplitudes)) + 1e-12;
  const auto count = static_cast<Index>(matches.size());
  Shifts shifts{Eigen::VectorXd(count), ArrayXd(count), ArrayXd(count)};
  for (Index i = 0; i < count; ++i) {
    const RimMatch& match = matches[static_cast<std::size_t>(i)];
    const double likeness = std::max(0.0, match.correlation - kLeastCorrelation);
    const double strength = match.amplitude / typical;
    shifts.px[i] = match.shift_px;
    shifts.prior[i] = likeness * std::min(1.0, strength * strength) * match.precision;
    shifts.evening[i] = 1 / match.spread_px;
  }
  return shifts;
}

ArrayXd Biweight(const ArrayXd& z) { return (1 - z.square()).max(0.0).square(); }
// d(z w(z))/dz: what a residual still adds to the estimate when it grows.
ArrayXd BiweightSlope(const ArrayXd& z) { return (1 - z.square()).max(0.0) * (1 - 5 * z.square()); }

// Residuals near each other on the rim are correlated (a glint, the grain of the ground), so the
// scatter is taken from the scores of whole blocks, g_b = sum over the block of w J r, and of
// neighbouring blocks together (Newey and West 1987):
// A^-1 (sum_b g_b g_b^T + (g_b g_{b+1}^T + g_{b+1} g_b^T)/2) A^-1. The fit has taken 5 degrees of
// freedom out of the B blocks, which costs B/(B - 5 (1 + cos(2 pi/B))). The slope share squared is
// due to any M-estimator (Huber 1981, 6.3). So few scores scatter much about each coordinate; half
// of the covariance is A^-1 times what they say of all five unknowns together.
Eigen::Matrix2d CenterCovariance(const RimJacobian& jacobian,
                                 const Eigen::VectorXd& weighted_residual,
                                 const Matrix5d& normal,
                                 double slope_share) {
  const Index count = jacobian.rows();
  std::vector<Vector5d> scores(kBlocks, Vector5d::Zero());
  for (Index i = 0; i < count; ++i) {
    scores[static_cast<std::size_t>(i * kBlocks / count)] +=
        weighted_residual[i] * jacobian.row(i).transpose();
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
  const double even = (inverse * scatter).trace() / 5;
  const Matrix5d covariance = 0.5 * (inverse * scatter * inverse + even * inverse);
  return factor * covariance.topLeftCorner<2, 2>();
}

struct NormalEquations {
  Matrix5d normal;
  Vector5d right;
};

// Of what is known beforehand: that the semi-axes part by no more than flattening_px, as
// (shape_xx - shape_yy) / 2 and shape_xy say. To be multiplied by the variance of an independent
// profile.
NormalEquations ExpectRound(const Eigen::Matrix2d& shape, double flattening_px) {
  NormalEquations round{Matrix5d::Zero(), Vector5d::Zero()};
  if (!(flattening_px > 0)) return round;
  Vector5d difference, shear;
  difference << 0, 0, 0.5, 0, -0.5;
  shear << 0, 0, 0, 1, 0;
  const double weight = 1 / (flattening_px * flattening_px);
  round.normal = weight * (difference * difference.transpose() + shear * shear.transpose());
  round.right = -weight * (0.5 * (shape(0, 0) - shape(1, 1)) * difference + shape(0, 1) * shear);
  return round;
}

NormalEquations WeightedEquations(const RimJacobian& jacobian,
                                  const ArrayXd& weight,
                                  const Eigen::VectorXd& shift_px) {
  const RimJacobian weighted = jacobian.array().colwise() * weight;
  NormalEquations equations{kDamping.asDiagonal(), weighted.transpose() * shift_px};
  for (Index i = 0; i < 5; ++i) {
    for (Index k = 0; k <= i; ++k) equations.normal(i, k) += weighted.col(i).dot(jacobian.col(k));
  }
  equations.normal.triangularView<Eigen::StrictlyUpper>() = equations.normal.transpose();
  return equations;
}

double MedianAbsoluteOf(const ArrayXd& values) {
  return MedianAbsolute({values.data(), values.data() + values.size()});
}

}  // namespace

RimUpdate FitShifts(const RimProfiles& profiles,
                    const std::vector<RimMatch>& matches,
                    const RimEllipse& rim,
                    const ShiftFitOptions& options) {
  const Shifts shifts = ShiftsOf(matches);
  const RimJacobian& jacobian = profiles.jacobian;
  const auto count = static_cast<double>(matches.size());
  RimUpdate update;
  update.residual_px = shifts.px;
  double scatter_px = profiles.t[profiles.t.size() - 1] / 2;
  NormalEquations equations;
  ArrayXd z, weight;
  for (int round = 0; round < kReweightings; ++round) {
    z = update.residual_px.array() * shifts.evening / (options.outlier_sigmas * scatter_px);
    weight = shifts.prior * Biweight(z);
    equations = WeightedEquations(jacobian, weight, shifts.px);
    if (round + 1 == kReweightings) {
      // Only now, as the scatter about an ellipse held round would say that it may be held so.
      // Neighbouring profiles err alike: a block of them is one observation.
      const double variance_px2 = scatter_px * scatter_px * count / kBlocks;
      const NormalEquations round_rim = ExpectRound(rim.shape, options.flattening_px);
      equations.normal += variance_px2 * round_rim.normal;
      equations.right += variance_px2 * round_rim.right;
    }
    update.change = equations.normal.ldlt().solve(equations.right);
    update.residual_px = shifts.px - jacobian * update.change;
    const double spread = MedianAbsoluteOf(update.residual_px.array() * shifts.evening);
    scatter_px = std::clamp(kSigmaPerMedian * spread, kLeastScatterPx, scatter_px);
  }
  z = update.residual_px.array() * shifts.evening / (options.outlier_sigmas * scatter_px);
  const double slopes = (shifts.prior * BiweightSlope(z)).sum();
  const double weights = (shifts.prior * Biweight(z)).sum() + 1e-12;
  update.center_covariance = CenterCovariance(jacobian,
                                              weight * update.residual_px.array(),
                                              equations.normal,
                                              std::max(slopes / weights, kLeastSlopeShare));
  return update;
}

}  // namespace bladecurve
