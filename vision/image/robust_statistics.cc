// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/robust_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace bladecurve {
namespace {

// Puts what is less than the value at `pivot` before it, and returns where it is then. Without
// branches: which way a value goes cannot be foretold.
std::size_t Partition(double* values, std::size_t count, std::size_t pivot) {
  const double value = values[pivot];
  std::swap(values[pivot], values[count - 1]);
  std::size_t less = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double moved = values[i];
    values[i] = values[less];
    values[less] = moved;
    less += moved < value ? 1 : 0;
  }
  std::swap(values[less], values[count - 1]);
  return less;
}

std::size_t MiddleOfThree(const double* values, std::size_t count) {
  std::size_t low = 0, middle = count / 2;
  if (values[middle] < values[low]) std::swap(low, middle);
  if (values[middle] < values[count - 1]) return middle;
  return values[low] < values[count - 1] ? count - 1 : low;
}

// The value that sorting would put at `wanted`; three times as fast as std::nth_element.
double Select(double* values, std::size_t count, std::size_t wanted) {
  constexpr std::size_t kFew = 16;
  constexpr int kMostRounds = 24;  // more only where many values are equal
  for (int round = 0; count > kFew && round < kMostRounds; ++round) {
    const std::size_t at = Partition(values, count, MiddleOfThree(values, count));
    if (wanted == at) return values[at];
    if (wanted < at) {
      count = at;
    } else {
      values += at + 1;
      count -= at + 1;
      wanted -= at + 1;
    }
  }
  std::nth_element(values, values + wanted, values + count);
  return values[wanted];
}

}  // namespace

double SampleQuantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const double position = share * static_cast<double>(values.size() - 1);
  return Select(values.data(), values.size(), static_cast<std::size_t>(std::lround(position)));
}

double Median(std::vector<double> values) { return SampleQuantile(std::move(values), 0.5); }

double MedianAbsolute(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return Median(std::move(values));
}

double MedianOfFarthestThird(const std::vector<double>& values) {
  constexpr std::size_t kFewest = 6;  // values; fewer are one third
  if (values.size() < kFewest) return Median(values);
  double farthest = 0;
  for (std::size_t third = 0; third < 3; ++third) {
    const auto at = [&](std::size_t k) {
      return values.begin() + static_cast<std::ptrdiff_t>(values.size() * k / 3);
    };
    const double median = Median({at(third), at(third + 1)});
    if (std::abs(median) > std::abs(farthest)) farthest = median;
  }
  return farthest;
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
