// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bladecurve {

// The value below which the given part (0 to 1) of the values lies; there must be one at least.
[[nodiscard]] double Quantile(std::vector<double> values, double part);

// Quantile of the standard normal distribution.
[[nodiscard]] double NormalQuantile(double probability);

// Quantile of chi-square by Wilson and Hilferty (1931): to 1 % for 3 degrees of freedom and more.
[[nodiscard]] double ChiSquareQuantile(double freedom, double probability);

// How many neighbours along a series of residuals vary as one: 1 + 2 sum of the autocorrelations up
// to the first that is not positive. 1 for independent residuals.
[[nodiscard]] double CorrelatedNeighbours(const std::vector<double>& residuals);

}  // namespace bladecurve
