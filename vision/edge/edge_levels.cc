// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/image/robust_statistics.h"

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
  Eigen::Matrix<double, kLevelTerms + 1, 1> values;
  values << terms, light;
  products.noalias() += (weight * values) * values.transpose();
  pixels += 1;
}

void LevelMoments::Add(const LevelMoments& other, double factor) {
  products += factor * other.products;
  pixels += factor * other.pixels;
}

namespace {

// Inverse of a positive definite matrix by Cholesky; unrolled for its size, five times the speed of
// a general solver.
LevelMatrix InverseOfPositive(const LevelMatrix& matrix) {
  LevelMatrix lower = LevelMatrix::Zero(), inverse = LevelMatrix::Zero();  // matrix = lower lower'
  for (int j = 0; j < kLevelTerms; ++j) {
    double pivot = matrix(j, j);
    for (int k = 0; k < j; ++k) pivot -= lower(j, k) * lower(j, k);
    lower(j, j) = std::sqrt(std::max(pivot, 1e-300));
    for (int i = j + 1; i < kLevelTerms; ++i) {
      double rest = matrix(i, j);
      for (int k = 0; k < j; ++k) rest -= lower(i, k) * lower(j, k);
      lower(i, j) = rest / lower(j, j);
    }
  }
  for (int j = 0; j < kLevelTerms; ++j) {
    inverse(j, j) = 1 / lower(j, j);
    for (int i = j + 1; i < kLevelTerms; ++i) {
      double rest = 0;
      for (int k = j; k < i; ++k) rest -= lower(i, k) * inverse(k, j);
      inverse(i, j) = rest / lower(i, i);
    }
  }
  return inverse.transpose().lazyProduct(inverse);
}

// What the mean square of `count` standard normal numbers exceeds as rarely as one of them exceeds
// three (Wilson and Hilferty 1931).
double MeanSquareBeyond3Sigma(double count) {
  constexpr double kSigmas = 3;
  const double variance = 2 / (9 * count);  // of the cube root of the mean square
  return std::pow(1 - variance + kSigmas * std::sqrt(variance), 3);
}

// What noise alone does in windows that share pixels: neighbours correlate the less the further
// apart they are.
struct SharedNoise {
  double independent = 0;  // windows would have as certain a mean square (Satterthwaite 1946)
  double alike = 0;        // windows count as one in a mean
};

SharedNoise NoiseOf(size_t windows, double overlap) {
  double sum = 0, squares = 0;  // of the correlations of all pairs
  const auto count = static_cast<double>(windows);
  for (double apart = 0; apart < std::min(count, overlap); ++apart) {
    const double pairs = (apart == 0 ? 1 : 2) * (count - apart), correlation = 1 - apart / overlap;
    sum += pairs * correlation;
    squares += pairs * correlation * correlation;
  }
  return {count * count / squares, sum / count};
}

}  // namespace

LevelFit SolveLevels(const LevelMoments& moments, const LevelVector& precision) {
  const LevelMatrix gram = moments.products.topLeftCorner<kLevelTerms, kLevelTerms>();
  const LevelVector right = moments.products.topRightCorner<kLevelTerms, 1>();
  LevelMatrix normal = gram;
  normal.diagonal() += precision;
  // A term that no pixel sees gets a harmless diagonal: its coefficient is then zero, its variance
  // huge.
  constexpr double kUnseen = 1e-9;
  normal.diagonal().array() +=
      kUnseen * std::max(gram(kBlade, kBlade) + gram(kGround, kGround), 1e-6);
  const LevelMatrix covariance = InverseOfPositive(normal);

  LevelFit fit;
  fit.levels = covariance * right;
  fit.variances = covariance.diagonal();
  const double rest = moments.products(kLevelTerms, kLevelTerms) - fit.levels.dot(right);
  fit.chi_square_per_pixel =
      std::max(rest, 0.0) / std::max(moments.pixels - static_cast<double>(kLevelTerms), 1.0);
  const double contrast = fit.Contrast();
  const double square = contrast * contrast;
  fit.offset_information = square / fit.variances[kShift];
  fit.kept_information =
      std::clamp(1 / (fit.variances[kShift] * std::max(gram(kShift, kShift), 1e-30)), 1e-3, 1.0);
  fit.spread_information = square / fit.variances[kSpread];
  if (square > 0) {
    fit.offset_px = -fit.levels[kShift] / contrast;
    fit.spread_px = fit.levels[kSpread] / contrast;
  }
  return fit;
}

LevelVector SlopePrecision(const std::vector<LevelFit>& fits, double overlap) {
  constexpr double kCommonSigmas = 3.5;
  LevelVector precision = LevelVector::Zero();
  const auto count = static_cast<double>(fits.size());
  const SharedNoise noise = NoiseOf(fits.size(), overlap);
  const double most = MeanSquareBeyond3Sigma(noise.independent);
  const double most_common = noise.alike * kCommonSigmas * kCommonSigmas;
  for (const LevelTerm term : {kBladeSlope, kGroundSlope, kGroundBend}) {
    double scatter = 0, squares = 0;     // of the levels: their squares, and those in sigmas
    double common = 0, information = 0;  // of their mean, weighted: its numerator and denominator
    for (const LevelFit& fit : fits) {
      const double level = fit.levels[term], variance = std::max(fit.variances[term], 1e-30);
      scatter += level * level;
      squares += level * level / variance;
      common += level / variance;
      information += 1 / variance;
    }
    const bool supported = squares > most * count || common * common > most_common * information;
    precision[term] = supported ? count / scatter : kFixed;
  }
  return precision;
}

double FaceShift(const std::vector<LevelFit>& windows) {
  constexpr double kMost = 0.5;              // px a round
  constexpr double kPriorInformation = 100;  // 1/px^2
  std::vector<std::pair<double, double>> steps{{0.0, kPriorInformation}};
  for (const LevelFit& window : windows) {
    const double height = window.levels[kFace];
    steps.emplace_back(window.levels[kFaceShift] / (height == 0 ? 1.0 : height),
                       height * height / window.variances[kFaceShift] /
                           std::max(window.chi_square_per_pixel, 1.0));
  }
  return std::clamp(WeightedMedian(std::move(steps)), -kMost, kMost);
}

}  // namespace bladecurve
