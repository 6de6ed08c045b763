// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/gap_trend.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

// Median of each value and its neighbours: single strays aside.
std::vector<double> Smoothed(const std::vector<double>& values) {
  constexpr std::ptrdiff_t kReach = 4;
  std::vector<double> smooth;
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    smooth.push_back(Median({values.begin() + std::max<std::ptrdiff_t>(0, i - kReach),
                             values.begin() + std::min(count, i + kReach + 1)}));
  }
  return smooth;
}

// How many of the values, counted from the first, lie beyond where they leave zero, as seen from
// their middle: first by half of `tolerance`, then by all of it. An edge may come back at its end.
template <typename Iterator>
std::size_t CountOff(Iterator first, Iterator last, double tolerance) {
  const auto middle = first + std::distance(first, last) / 2;
  std::size_t count = 0;
  for (auto value = middle; value != first;) {
    --value;
    const double off = std::abs(*value);
    if (off <= 0.5 * tolerance) {
      count = 0;
    } else if (count == 0) {
      count = static_cast<std::size_t>(std::distance(first, value)) + 1;
    }
    if (off > tolerance) return count;
  }
  return 0;
}

}  // namespace

Trend TrendOf(const EdgeGap& gap, Eigen::Index terms) {
  constexpr double kFrom = 0.2, kTo = 0.7;  // shares of the gap's length
  constexpr int kRounds = 4;
  constexpr double kFar = 3;  // scatters
  const auto at = [&](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(gap.along.size()));
  };
  Trend trend;
  trend.course.origin = gap.along[at(0.5 * (kFrom + kTo))];
  trend.course.length = gap.along.back() - gap.along.front();
  trend.scatter = std::numeric_limits<double>::infinity();
  trend.off.assign(gap.along.size(), 0.0);
  for (int round = 0; round < kRounds; ++round) {
    trend.course.Fit(gap, terms, [&](std::size_t i) {
      return i >= at(kFrom) && i < at(kTo) && std::abs(trend.off[i]) <= kFar * trend.scatter;
    });
    for (std::size_t i = 0; i < gap.along.size(); ++i)
      trend.off[i] = gap.apart[i] - trend.course.At(gap.along[i]);
    const auto middle = [&](double share) {
      return trend.off.begin() + static_cast<std::ptrdiff_t>(at(share));
    };
    trend.scatter = kSigmaPerMedian * MedianAbsolute({middle(kFrom), middle(kTo)});
  }
  return trend;
}

Parting PartingFrom(const Trend& trend, double tolerance) {
  const std::vector<double> off = Smoothed(trend.off);
  return {CountOff(off.rbegin(), off.rend(), tolerance),
          CountOff(off.begin(), off.end(), tolerance)};
}

}  // namespace bladecurve
