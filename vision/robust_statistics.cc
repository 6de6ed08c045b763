// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/robust_statistics.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {

double SampleQuantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const double position = share * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + std::lround(position);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double Median(std::vector<double> values) { return SampleQuantile(std::move(values), 0.5); }

double MedianAbsolute(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return Median(std::move(values));
}

double WeightedMedian(std::vector<std::pair<double, double>> value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0, passed = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  for (const auto& [value, weight] : value_and_weight) {
    passed += weight;
    if (2 * passed >= total) return value;
  }
  return 0;
}

double RobustSigma(const std::vector<double>& deviations) {
  constexpr double kSigmaPerMean = 1.2533, kOutlier = 4;
  if (deviations.empty()) return 0;
  double sum = 0;
  for (const double deviation : deviations) sum += std::abs(deviation);
  const double limit = kOutlier * kSigmaPerMean * sum / static_cast<double>(deviations.size());
  double squares = 0, count = 0;
  for (const double deviation : deviations) {
    if (std::abs(deviation) > limit) continue;
    squares += deviation * deviation;
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

}  // namespace bladecurve
