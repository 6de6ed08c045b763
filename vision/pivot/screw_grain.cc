// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_grain.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kAlongTurns =
    1.0 / 32;                     // Gaussian sigma along the rim within which noise is alike
constexpr double kLeast = 1e-12;  // keeps perfect pictures solvable

double MedianOf(const VectorXd& values) {
  return Median({values.data(), values.data() + values.size()});
}

double SigmaAlong(Index count) { return std::max(1.0, kAlongTurns * static_cast<double>(count)); }

VectorXd AmplitudesOf(const RimMatches& matches) {
  VectorXd amplitudes(static_cast<Index>(matches.each.size()));
  for (Index i = 0; i < amplitudes.size(); ++i)
    amplitudes[i] = matches.each[static_cast<std::size_t>(i)].amplitude;
  return amplitudes;
}

// The shape with the slope that all profiles have in common, which is mostly its own.
RimShape WithSlope(const RimProfiles& profiles, RimShape shape, double amplitude) {
  const VectorXd wt = profiles.window.cwiseProduct(profiles.t);
  const double slope = MedianOf(profiles.values * wt) / wt.dot(profiles.t) / amplitude;
  shape.value += slope * profiles.t;
  shape.derivative.array() += slope;
  return shape;
}

RimRows WithoutLevel(const RimProfiles& profiles) {
  const double level = MedianOf(profiles.values * profiles.window) / profiles.window.sum();
  return profiles.values.array() - level;
}

// What the common shape leaves over of each profile.
struct Leftover {
  RimRows rows;
  VectorXd plain;   // 1: tells the noise; 0: something else than the rim is in it
  VectorXd strays;  // 1: its level or slope is far from the usual: a slot, a facet
};

// 1 where a value lies further from the median than all but one in 400 of a normal law.
VectorXd FarOut(const VectorXd& values) {
  constexpr double kSigmas = 3;
  const VectorXd off = (values.array() - MedianOf(values)).abs();
  return (off.array() > kSigmas * kSigmaPerMedian * MedianOf(off) + kLeast).cast<double>();
}

Leftover LeftoverOf(const RimProfiles& profiles, const RimRows& values, const RimMatches& matches) {
  constexpr double kAlike = 0.6;  // correlation; less is something else than the rim
  const VectorXd amplitudes = AmplitudesOf(matches);
  Leftover left;
  left.rows = values - amplitudes * matches.shape.value.transpose();
  left.strays = FarOut(left.rows * profiles.window)
                    .cwiseMax(FarOut(left.rows * profiles.window.cwiseProduct(profiles.t)));
  left.plain = VectorXd::Ones(values.rows()) - left.strays;
  for (Index i = 0; i < values.rows(); ++i) {
    const RimMatch& match = matches.each[static_cast<std::size_t>(i)];
    if (match.correlation < kAlike || match.amplitude < 0) left.plain[i] = 0;
  }
  left.rows.array().colwise() *= left.plain.array();
  return left;
}

// Autocovariance of each row, lags from 0; with this divisor it is positive definite.
RimRows Autocovariances(const RimRows& rows) {
  const Index taps = rows.cols();
  RimRows result(rows.rows(), taps);
  for (Index lag = 0; lag < taps; ++lag) {
    result.col(lag) =
        rows.leftCols(taps - lag).cwiseProduct(rows.rightCols(taps - lag)).rowwise().sum() /
        static_cast<double>(taps);
  }
  return result;
}

// Weighted means over the neighbourhood of each row and the one opposite, where the rim runs in the
// same direction; where few rows have weight, much the mean of all.
RimRows LocalMeans(const RimRows& rows, const VectorXd& weights) {
  constexpr double kCommon = 0.5;  // weight of the mean of all: few rows tell little of noise
  const Index count = rows.rows(), half = count / 2;
  RimRows sums(count, rows.cols() + 1), both(count, rows.cols() + 1);
  sums << (rows.array().colwise() * weights.array()).matrix(), weights;
  const Eigen::RowVectorXd total = sums.colwise().sum();
  const Eigen::RowVectorXd common = total / std::max(total[rows.cols()], kLeast);
  both.topRows(count - half) = sums.topRows(count - half) + sums.bottomRows(count - half);
  both.bottomRows(half) = sums.bottomRows(half) + sums.topRows(half);
  const SmoothedRows smooth = SmoothAlongRim(both, SigmaAlong(count));
  RimRows means = smooth.values / smooth.weights;
  means.rowwise() += kCommon * common;
  return means.leftCols(rows.cols()).array().colwise() / means.col(rows.cols()).array();
}

// Covariances that the taps of a profile have about each place of the rim, by their lags. Of means
// along the rim, times their length: what neighbours share does not average out.
RimRows NoiseAlongRim(const Leftover& left) {
  const SmoothedRows means = SmoothAlongRim(left.rows, SigmaAlong(left.rows.rows()));
  return LocalMeans(Autocovariances(means.values) / means.squared_weights, left.plain);
}

// Linear estimators of a and a d in  a f(t - d) ~ a f - (a d) f', for profiles of the usual level
// and for such of any level and slope.
struct GrainFilter {
  Eigen::Matrix<double, Eigen::Dynamic, 2> usual, freed;
  double usual_variance = 1, freed_variance = 1;  // of a d
};

GrainFilter MakeFilter(const RimProfiles& profiles,
                       const RimShape& shape,
                       const VectorXd& covariance_by_lag) {
  constexpr double kWhite = 0.01;  // of the noise, at least: rounding
  const Index taps = profiles.t.size();
  const VectorXd root = profiles.window.cwiseSqrt();
  Eigen::MatrixXd covariance(taps, taps);
  for (Index a = 0; a < taps; ++a) {
    for (Index b = 0; b < taps; ++b)
      covariance(a, b) = covariance_by_lag[std::abs(a - b)] / (root[a] * root[b]);
  }
  covariance.diagonal().array() += kWhite * covariance_by_lag[0] + kLeast;
  Eigen::Matrix<double, Eigen::Dynamic, 4> basis(taps, 4);
  basis << shape.value, -shape.derivative, VectorXd::Ones(taps), profiles.t;
  const Eigen::Matrix<double, Eigen::Dynamic, 4> weighted = covariance.ldlt().solve(basis);
  const Eigen::Matrix4d normal = basis.transpose() * weighted;
  const Eigen::Matrix2d usual = normal.topLeftCorner<2, 2>().inverse();
  const Eigen::Matrix<double, 4, 2> freed = normal.inverse().leftCols<2>();
  return {weighted.leftCols<2>() * usual, weighted * freed, usual(1, 1), freed(1, 1)};
}

// Amplitude, shift and precision of one profile.
void Rematch(const GrainFilter& filter,
             const Eigen::RowVectorXd& values,
             bool strays,
             double most_shift_px,
             RimMatch& match) {
  const Eigen::RowVector2d solution = values * (strays ? filter.freed : filter.usual);
  match.amplitude = solution[0];
  const double safe = std::copysign(std::max(std::abs(match.amplitude), kLeast), match.amplitude);
  match.shift_px = std::clamp(solution[1] / safe, -most_shift_px, most_shift_px);
  match.precision = 1 / (strays ? filter.freed_variance : filter.usual_variance);
}

void Normalize(const RimShape& shape, const VectorXd& plain, std::vector<RimMatch>& matches) {
  RimRows squares(plain.size(), 1);
  double precision = 0;
  for (Index i = 0; i < plain.size(); ++i) {
    const RimMatch& match = matches[static_cast<std::size_t>(i)];
    squares(i, 0) = match.shift_px * match.shift_px + kLeast;
    precision += match.precision / static_cast<double>(plain.size());
  }
  const RimRows local = LocalMeans(squares, plain);
  const double mean = local.mean();
  for (Index i = 0; i < plain.size(); ++i) {
    RimMatch& match = matches[static_cast<std::size_t>(i)];
    match.precision /= precision;
    match.spread_px = std::sqrt(local(i, 0) / mean);
    match.shift_px += shape.center_px;
  }
}

}  // namespace

void MatchInGrain(const RimProfiles& profiles, RimMatches& matches) {
  constexpr double kLeastPlain = 0.5;  // of the rim; less is lit from one side, its level is no use
  constexpr Index kPlaces = 32;        // of the rim with a filter of their own
  const double amplitude = MedianOf(AmplitudesOf(matches));
  if (!(amplitude > 0)) return;
  const RimShape shape = WithSlope(profiles, matches.shape, amplitude);
  const RimRows values = WithoutLevel(profiles);
  const Leftover left = LeftoverOf(profiles, values, {shape, matches.each});
  if (left.plain.mean() < kLeastPlain) return;
  const RimRows noise = NoiseAlongRim(left);
  const Index count = values.rows(), stride = (count + kPlaces - 1) / kPlaces;
  const double most_shift_px = kMostRelativeShift * profiles.t[profiles.t.size() - 1];
  ParallelFor(static_cast<int>((count + stride - 1) / stride), [&](int place) {
    const Index first = place * stride;
    const GrainFilter filter = MakeFilter(profiles, shape, noise.row(first).transpose());
    for (Index i = first; i < std::min(first + stride, count); ++i) {
      Rematch(filter,
              values.row(i),
              left.strays[i] > 0,
              most_shift_px,
              matches.each[static_cast<std::size_t>(i)]);
    }
  });
  Normalize(shape, left.plain, matches.each);
}

}  // namespace bladecurve
