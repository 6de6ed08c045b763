// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

namespace bladecurve {

// Of a normal distribution: standard deviation over median of the absolute values.
inline constexpr double kSigmaPerMedian = 1.4826;

// All return 0 for no values.

// The value that `share` of the values lie below; share in [0, 1].
[[nodiscard]] double SampleQuantile(std::vector<double> values, double share);
[[nodiscard]] double Median(std::vector<double> values);
[[nodiscard]] double MedianAbsolute(std::vector<double> values);
// Of the medians of the first, the middle and the last third of the values the one farthest from 0;
// of fewer than six values, their median.
[[nodiscard]] double MedianOfFarthestThird(const std::vector<double>& values);
[[nodiscard]] double WeightedMedian(std::vector<std::pair<double, double>> value_and_weight);

// Standard deviation about zero without the outliers. Not from a median: in a smooth picture most
// grey values are rounded to the same.
[[nodiscard]] double RobustSigma(const std::vector<double>& deviations);

}  // namespace bladecurve
