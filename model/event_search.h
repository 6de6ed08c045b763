// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace bladecurve {

// A function of the path parameter s and its slope there.
struct Rate {
  double value = 0;
  double slope = 0;
};

// The first s with rate(s).value >= 0 in a bracket with rate(a).value < 0 <= rate(b).value: Newton,
// kept inside the bracket by bisection. The value at the s returned is >= 0. At most 64
// evaluations; real-time safe.
template <class RateFunction>
[[nodiscard]] double RootInBracket(const RateFunction& rate, double a, double b) noexcept {
  constexpr int kMostEvaluations = 64;  // bisection alone ends at the last bit of s in 53
  double s = 0.5 * (a + b), last_value = 0, nudge = 0;
  for (int i = 0; i < kMostEvaluations && s > a && s < b; ++i) {
    const Rate here = rate(s);
    const double step = here.slope > 0 ? -here.value / here.slope : 0;
    (here.value >= 0 ? b : a) = s;
    const double newton = s + step;
    const double resolution = 4e-16 * std::abs(s);
    // Near the root rounding makes a staircase of the rate: on one of its steps Newton stands
    // still.
    const bool rounded = std::abs(step) < resolution || here.value == last_value;
    last_value = here.value;
    if (step != 0 && rounded) {
      if (here.value >= 0) return s;
      nudge = std::max({resolution, std::abs(step), 4 * nudge});
      s += nudge;
    } else {
      s = (step != 0 && newton > a && newton < b) ? newton : 0.5 * (a + b);
    }
  }
  return b;
}

// The first s of (a, b] at which rate reaches zero from below, if it does; a itself counts as
// below. Sees a crossing inside also where the value is below zero at both ends but its slopes say
// that it had a maximum between. The interval must be short enough for at most one maximum. At most
// 112 evaluations.
template <class RateFunction>
[[nodiscard]] std::optional<double> FirstReach(
    const RateFunction& rate, double a, Rate at_a, double b, Rate at_b) noexcept {
  if (at_b.value >= 0) return RootInBracket(rate, a, b);
  if (at_a.slope <= 0 || at_b.slope >= 0) return std::nullopt;
  constexpr int kMostEvaluations = 48;
  double low = a, high = b;  // the slope is positive at low, negative at high
  for (int i = 0; i < kMostEvaluations; ++i) {
    const double s = 0.5 * (low + high);
    if (s <= low || s >= high) break;
    const Rate here = rate(s);
    if (here.value >= 0) return RootInBracket(rate, a, s);
    // A tangent at each end bounds a concave value from above: where they meet below zero, nothing
    // is reached.
    const double bound = here.value + std::abs(here.slope) * (high - low);
    if (bound < 0) return std::nullopt;
    (here.slope > 0 ? low : high) = s;
  }
  return std::nullopt;
}

}  // namespace bladecurve
