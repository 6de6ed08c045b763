// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/luma_shift.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace bladecurve {
namespace {

using Eigen::Vector3d;

// The value, not whole, that a channel of such light is stored as.
double StoredValue(const ToneCurve& tone, double light) {
  const auto above = std::upper_bound(tone.linear.begin(), tone.linear.end(), light);
  if (above == tone.linear.begin()) return 0;
  const auto below = static_cast<double>(std::distance(tone.linear.begin(), above)) - 1;
  if (above == tone.linear.end()) return below;
  const double from = *std::prev(above), to = *above;
  return below + (light - from) / (to - from);
}

double LightOfValue(const ToneCurve& tone, double value) {
  const double clamped = std::clamp(value, 0.0, 255.0);
  const auto below = static_cast<std::size_t>(std::min(clamped, 254.0));
  return std::lerp(
      tone.linear[below], tone.linear[below + 1], clamped - static_cast<double>(below));
}

}  // namespace

double LightInGrey(const Vector3d& bgr, const ToneCurve& tone) {
  constexpr double kBlue = 0.114, kGreen = 0.587, kRed = 0.299;
  return LightOfValue(tone,
                      kBlue * StoredValue(tone, bgr[0]) + kGreen * StoredValue(tone, bgr[1]) +
                          kRed * StoredValue(tone, bgr[2]));
}

double LumaShift(const Vector3d& from, const Vector3d& to, const ToneCurve& tone) {
  constexpr double kReach = 4, kStep = 0.25;  // standard deviations
  constexpr double kMost = 0.5, kLeastHeight = 1e-3;
  const double start = LightInGrey(from, tone), height = LightInGrey(to, tone) - start;
  if (std::abs(height) < kLeastHeight) return 0;
  double product = 0, squares = 0;
  for (double x = -kReach; x <= kReach; x += kStep) {
    const double slope = std::exp(-0.5 * x * x);
    const double share = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double seen = (LightInGrey(from + share * (to - from), tone) - start) / height;
    product += (share - seen) * slope;
    squares += slope * slope;
  }
  const double per_slope = std::sqrt(2 * std::numbers::pi);  // of the normal distribution
  return std::clamp(per_slope * product / squares, -kMost, kMost);
}

}  // namespace bladecurve
