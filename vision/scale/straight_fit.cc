// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/straight_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "vision/scale/edge_profile.h"

namespace bladecurve {
namespace {

// Grey profile across the band, linear light, one value a pixel of distance, over part of its
// length.
std::vector<double> MeanProfile(const std::vector<BandSample>& samples,
                                const StraightEdgeBand& band,
                                const std::array<double, 2>& part) {
  const size_t count = static_cast<size_t>(2 * band.half_width) + 1;
  std::vector<double> sum(count, 0), weight(count, 0);
  for (const BandSample& s : samples) {
    const double place = s.along / band.length + 0.5;
    if (place < part[0] || place > part[1]) continue;
    const size_t k = std::min(count - 1, static_cast<size_t>(s.across + band.half_width));
    sum[k] += s.light;
    weight[k] += 1;
  }
  for (size_t k = 0; k < count; ++k) sum[k] = weight[k] > 0 ? sum[k] / weight[k] : -1;
  return sum;
}

// Where the profile crosses the middle between its ends; distance from the band's middle.
std::optional<double> HalfLevelCrossing(const std::vector<double>& profile, double half_width) {
  const double start = profile[1], end = profile[profile.size() - 2];
  if (start < 0 || end < 0 || start == end) return std::nullopt;
  const double half = 0.5 * (start + end);
  for (size_t k = 1; k + 2 < profile.size(); ++k) {
    const double p = profile[k], q = profile[k + 1];
    if (p < 0 || q < 0 || (p < half) == (q < half)) continue;
    return static_cast<double>(k) + 0.5 + (half - p) / (q - p) - half_width;
  }
  return std::nullopt;
}

class EdgeModel {
 public:
  EdgeModel(const StraightEdgeBand& band, const StraightVector& p)
      : p_(p),
        cos_(std::cos(p[kAngle])),
        sin_(std::sin(p[kAngle])),
        scale_(1 / band.length),
        profile_(std::atan2(band.normal.y(), band.normal.x()) + p[kAngle], p[kEdgeBlur]) {}

  // Residual, light minus model, and the model's derivatives. Light beyond white is stored as
  // white.
  double Residual(const BandSample& s, StraightVector* gradient) const {
    const double distance = s.across * cos_ - s.along * sin_ - p_[kOffset];
    const EdgeProfile::Value step = profile_.At(distance);
    const double light = p_[kDark] + p_[kContrast] * step.level;
    const double lamp = 1 + p_[kAlong] * s.along * scale_;
    if (lamp * light >= 1) {
      gradient->setZero();
      return s.light - 1;
    }
    const double edge = lamp * p_[kContrast] * step.slope_per_px;
    *gradient << -edge, -edge * s.along, lamp, lamp * step.level,
        lamp * p_[kContrast] * p_[kEdgeBlur] * step.curvature_per_px2, light * s.along * scale_;
    return s.light - lamp * light;
  }

 private:
  const StraightVector& p_;
  double cos_, sin_, scale_;
  EdgeProfile profile_;
};

struct NormalEquations {
  StraightMatrix information = StraightMatrix::Zero();
  StraightVector gradient = StraightVector::Zero();
  double sum_square = 0;
};

NormalEquations Accumulate(const std::vector<BandSample>& samples,
                           const StraightEdgeBand& band,
                           const StraightVector& parameters) {
  const EdgeModel model(band, parameters);
  NormalEquations equations;
  StraightVector derivative;
  for (const BandSample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    equations.information.noalias() += derivative * derivative.transpose();
    equations.gradient += residual * derivative;
    equations.sum_square += residual * residual;
  }
  return equations;
}

// Sandwich estimate with the pieces along the edge as clusters: holds whatever the noise does
// within a piece. Compression makes it stronger at the edge and alike in neighbours, so that s^2
// (J'J)^-1 is up to five times too small.
StraightMatrix ClusteredCovariance(const std::vector<BandSample>& samples,
                                   const StraightEdgeBand& band,
                                   const StraightVector& parameters,
                                   const StraightMatrix& information) {
  const EdgeModel model(band, parameters);
  std::vector<StraightVector> scores(BinCount(band), StraightVector::Zero());
  StraightVector derivative;
  for (const BandSample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    scores[static_cast<size_t>(s.bin)] += residual * derivative;
  }
  StraightMatrix middle = StraightMatrix::Zero();
  double pieces = 0;
  for (const StraightVector& score : scores) {
    middle += score * score.transpose();
    pieces += score.isZero() ? 0 : 1;
  }
  const StraightMatrix inverse = information.ldlt().solve(StraightMatrix::Identity());
  // Few pieces fit their own noise: the usual correction for the parameters they feed.
  const double correction = pieces / std::max(1.0, pieces - 2);
  return correction * inverse * middle * inverse;
}

bool Plausible(const StraightVector& p, const StraightEdgeBand& band) {
  return p.allFinite() && p[kEdgeBlur] <= kMaxBlurPx && std::abs(p[kOffset]) < band.half_width &&
         std::abs(p[kAngle]) * band.length < 2 * band.half_width;
}

// The minimum next to `start`.
std::optional<StraightFit> RefineFrom(const std::vector<BandSample>& samples,
                                      const StraightEdgeBand& band,
                                      const StraightVector& start) {
  constexpr int kMaxSteps = 30;
  constexpr double kDonePx = 1e-5;
  StraightFit fit{start, StraightMatrix::Zero(), 0, samples.size()};
  NormalEquations now = Accumulate(samples, band, fit.parameters);
  double damping = 1e-4;
  for (int step = 0; step < kMaxSteps; ++step) {
    StraightMatrix damped = now.information;
    damped.diagonal() += damping * now.information.diagonal() + StraightVector::Constant(1e-9);
    const StraightVector change = damped.ldlt().solve(now.gradient);
    StraightVector next = fit.parameters + change;
    next[kEdgeBlur] = std::max(next[kEdgeBlur], kMinBlurPx);
    if (!Plausible(next, band)) return std::nullopt;
    const NormalEquations there = Accumulate(samples, band, next);
    if (there.sum_square > now.sum_square) {
      damping = std::max(10 * damping, 1e-3);
      if (damping > 1e6) break;
      continue;
    }
    fit.parameters = next;
    now = there;
    damping *= 0.1;
    if (std::abs(change[kOffset]) + std::abs(change[kAngle]) * band.length < kDonePx) break;
  }
  fit.covariance = ClusteredCovariance(samples, band, fit.parameters, now.information);
  fit.mean_square =
      now.sum_square / std::max(1.0, static_cast<double>(samples.size()) - kStraightParameters);
  return fit;
}

}  // namespace

double BrightSide(const StraightVector& p) { return p[kDark] + std::max(0.0, p[kContrast]); }

std::optional<StraightVector> StartOf(const std::vector<BandSample>& samples,
                                      const StraightEdgeBand& band) {
  constexpr int kParts = 6;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int part = 0; part < kParts; ++part) {
    const double from = static_cast<double>(part) / kParts;
    const auto profile = MeanProfile(samples, band, {from, from + 1.0 / kParts});
    const std::optional<double> crossing = HalfLevelCrossing(profile, band.half_width);
    if (!crossing) continue;
    const double x = (from + 0.5 / kParts - 0.5) * band.length;
    n += 1, sx += x, sy += *crossing, sxx += x * x, sxy += x * *crossing;
  }
  if (n < 3) return std::nullopt;  // rejects edges hidden along more than half their length
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  const auto profile = MeanProfile(samples, band, {0, 1});
  StraightVector start = StraightVector::Zero();
  start[kOffset] = (sy - slope * sx) / n;
  start[kAngle] = std::atan(slope);
  start[kDark] = profile[1];
  start[kContrast] = profile[profile.size() - 2] - profile[1];
  start[kEdgeBlur] = 1;
  return start;
}

std::optional<StraightFit> RefineStraight(const std::vector<BandSample>& samples,
                                          const StraightEdgeBand& band,
                                          const StraightVector& start) {
  constexpr double kNearlyWhite = 0.93, kBrighter = 0.5;  // light
  const std::optional<StraightFit> plain = RefineFrom(samples, band, start);
  if (!plain || BrightSide(start) < kNearlyWhite) return plain;
  StraightVector beyond_white = plain->parameters;
  if (beyond_white[kContrast] < 0) beyond_white[kDark] += kBrighter;
  beyond_white[kContrast] += std::copysign(kBrighter, beyond_white[kContrast]);
  const std::optional<StraightFit> glaring = RefineFrom(samples, band, beyond_white);
  return glaring && glaring->mean_square < plain->mean_square ? glaring : plain;
}

std::vector<BandSample> WithoutCovered(const std::vector<BandSample>& samples,
                                       const StraightEdgeBand& band,
                                       const StraightVector& parameters) {
  // A piece holds some 60 pixels, so its mean square scatters by a fifth; four times the median
  // is no chance.
  constexpr double kWorse = 4;
  const size_t bins = BinCount(band);
  std::vector<double> square(bins, 0), count(bins, 0), typical;
  const EdgeModel model(band, parameters);
  StraightVector derivative;
  for (const BandSample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    square[static_cast<size_t>(s.bin)] += residual * residual;
    count[static_cast<size_t>(s.bin)] += 1;
  }
  for (size_t k = 0; k < bins; ++k) {
    if (count[k] > 0) typical.push_back(square[k] /= count[k]);
  }
  std::nth_element(
      typical.begin(), typical.begin() + static_cast<long>(typical.size() / 2), typical.end());
  // Rounding to whole grey values alone leaves a hundred thousandth.
  const double limit = kWorse * std::max(typical[typical.size() / 2], 1e-6);
  std::vector<BandSample> kept;
  for (const BandSample& s : samples) {
    if (square[static_cast<size_t>(s.bin)] <= limit) kept.push_back(s);
  }
  return kept;
}

}  // namespace bladecurve
