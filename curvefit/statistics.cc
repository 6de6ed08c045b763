// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace bladecurve {

double Quantile(std::vector<double> values, double part) {
  const auto rank = static_cast<size_t>(part * static_cast<double>(values.size() - 1));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double NormalQuantile(double probability) {
  // Newton on the distribution function, from the logistic approximation, steps kept within 1.
  const double p = std::clamp(probability, 1e-15, 1 - 1e-15);
  double z = std::log(p / (1 - p)) / 1.702;
  for (int step = 0; step < 60; ++step) {
    const double excess = 0.5 * std::erfc(-z / std::numbers::sqrt2) - p;
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    const double change = std::clamp(excess / density, -1.0, 1.0);
    z -= change;
    if (std::abs(change) < 1e-12) break;
  }
  return z;
}

double ChiSquareQuantile(double freedom, double probability) {
  const double spread = 2 / (9 * freedom);
  const double root = 1 - spread + NormalQuantile(probability) * std::sqrt(spread);
  return freedom * std::pow(std::max(root, 0.0), 3);
}

double CorrelatedNeighbours(const std::vector<double>& residuals) {
  const size_t n = residuals.size();
  const double variance =
      std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  if (n < 8 || variance <= 0) return 1;
  constexpr size_t kLongest = 500;  // neighbours; longer waves are shape
  constexpr size_t kEach =
      16;  // lags one by one; later ones in growing steps, where the function is smooth
  const double noise = 2 / std::sqrt(static_cast<double>(n));
  double sum = 1;
  for (size_t lag = 1; lag < std::min(n / 4, kLongest); lag += 1 + lag / kEach) {
    const auto shifted = residuals.begin() + static_cast<std::ptrdiff_t>(lag);
    const double product = std::inner_product(shifted, residuals.end(), residuals.begin(), 0.0);
    if (product <= noise * variance) break;
    sum += 2 * static_cast<double>(1 + lag / kEach) * product / variance;
  }
  return sum;
}

}  // namespace bladecurve
