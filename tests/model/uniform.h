// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>

namespace bladecurve {

// Uniform in [low, high), the same numbers with every standard library.
[[nodiscard]] inline double Uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

// The same, spread evenly over the decades.
[[nodiscard]] inline double LogUniform(std::mt19937& random, double low, double high) {
  return std::exp(Uniform(random, std::log(low), std::log(high)));
}

}  // namespace bladecurve
