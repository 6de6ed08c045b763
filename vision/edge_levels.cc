// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_levels.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace bladecurve {

LevelVector LevelTerms(const StepSample& sample,
                       const StepSample& face,
                       double across_px,
                       double blur_variance) {
  const double d = across_px, s = sample.step;
  const double blurred_corner =
      blur_variance * sample.slope;  // what blur adds to a ramp that starts at the edge
  LevelVector terms;
  terms[kBlade] = 1 - s;
  terms[kBladeSlope] = d * (1 - s) - blurred_corner;
  terms[kGround] = s;
  terms[kGroundSlope] = d * s + blurred_corner;
  terms[kGroundBend] = (d * d + blur_variance) * s + d * blurred_corner;
  terms[kShift] = sample.slope;
  terms[kSpread] = sample.spread;
  terms[kFace] = 1 - face.step;
  terms[kFaceShift] = face.slope;
  return terms;
}

void LevelMoments::Add(const LevelVector& terms, double light, double weight) {
  const LevelVector weighted = weight * terms;
  gram.noalias() += weighted * terms.transpose();
  right += light * weighted;
  square += weight * light * light;
  pixels += 1;
}

void LevelMoments::Add(const LevelMoments& other, double factor) {
  gram += factor * other.gram;
  right += factor * other.right;
  square += factor * other.square;
  pixels += factor * other.pixels;
}

LevelFit SolveLevels(const LevelMoments& moments, const LevelVector& precision) {
  LevelMatrix normal = moments.gram;
  normal.diagonal() += precision;
  // A term that no pixel sees gets a harmless diagonal: its coefficient is then zero, its variance
  // huge.
  constexpr double kUnseen = 1e-9;
  normal.diagonal().array() +=
      kUnseen * std::max(moments.gram(kBlade, kBlade) + moments.gram(kGround, kGround), 1e-6);
  const LevelMatrix covariance = normal.llt().solve(LevelMatrix::Identity());

  LevelFit fit;
  fit.levels = covariance * moments.right;
  fit.variances = covariance.diagonal();
  const double rest = moments.square - fit.levels.dot(moments.right);
  fit.chi_square_per_pixel =
      std::max(rest, 0.0) / std::max(moments.pixels - static_cast<double>(kLevelTerms), 1.0);
  const double contrast = fit.Contrast();
  const double square = contrast * contrast;
  fit.offset_information = square / fit.variances[kShift];
  fit.kept_information = std::clamp(
      1 / (fit.variances[kShift] * std::max(moments.gram(kShift, kShift), 1e-30)), 1e-3, 1.0);
  fit.spread_information = square / fit.variances[kSpread];
  if (square > 0) {
    fit.offset_px = -fit.levels[kShift] / contrast;
    fit.spread_px = fit.levels[kSpread] / contrast;
  }
  return fit;
}

LevelVector SlopePrecision(const std::vector<LevelFit>& fits, double overlap) {
  LevelVector precision = LevelVector::Zero();
  const auto count = static_cast<double>(fits.size());
  for (const LevelTerm term : {kBladeSlope, kGroundSlope, kGroundBend}) {
    double excess = 0, scatter = 0;
    for (const LevelFit& fit : fits) {
      const double ratio =
          fit.levels[term] * fit.levels[term] / std::max(fit.variances[term], 1e-30);
      excess += ratio - 1;
      scatter += fit.levels[term] * fit.levels[term];
    }
    // Without slopes `excess` is 0 with standard deviation sqrt(2 count overlap).
    const bool supported = excess > 3 * std::sqrt(2 * count * overlap);
    precision[term] = supported ? count / scatter : kFixed;
  }
  return precision;
}

}  // namespace bladecurve
