// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/blurred_step.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace bladecurve {
namespace {

// The normal density and its first three integrals at one z.
struct Integrals {
  double density = 0, once = 0, twice = 0, thrice = 0;
};

constexpr double kTail = 5.5;  // Phi(-5.5) = 2e-8: nothing beyond
constexpr int kPerUnit = 64;   // cubic Hermite error (1/64)^4 / 384 * 0.5 < 1e-10
constexpr int kEntries = static_cast<int>(2 * kTail) * kPerUnit + 1;
constexpr double kThinnest =
    0.02;  // narrower flanks of the trapezoid are widened: changes S by < 2e-5

using Table = std::array<Integrals, kEntries>;

Table MakeTable() {
  Table table;
  for (size_t i = 0; i < table.size(); ++i) {
    const double z = -kTail + static_cast<double>(i) / kPerUnit;
    Integrals& at = table[i];
    at.density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    at.once = 0.5 * std::erfc(-z / std::numbers::sqrt2);
    at.twice = z * at.once + at.density;
    at.thrice = 0.5 * ((z * z + 1) * at.once + z * at.density);
  }
  return table;
}

// Cubic Hermite interpolation: each integral has the one before it as its derivative.
Integrals Interpolate(double z) {
  static const Table table = MakeTable();
  if (z <= -kTail) return {};
  if (z >= kTail) return {0, 1, z, 0.5 * (z * z + 1)};
  const double position = (z + kTail) * kPerUnit;
  const size_t i = std::min(static_cast<size_t>(position), table.size() - 2);
  const double t = position - static_cast<double>(i);
  const Integrals& p = table[i];
  const Integrals& q = table[i + 1];
  const double value_q = t * t * (3 - 2 * t), value_p = 1 - value_q;
  const double slope_p = t * (1 - t) * (1 - t) / kPerUnit, slope_q = -t * t * (1 - t) / kPerUnit;
  return {0,
          value_p * p.once + value_q * q.once + slope_p * p.density + slope_q * q.density,
          value_p * p.twice + value_q * q.twice + slope_p * p.once + slope_q * q.once,
          value_p * p.thrice + value_q * q.thrice + slope_p * p.twice + slope_q * q.twice};
}

}  // namespace

double BlurredPower(double across_px, int power, double blur_px) {
  const double z = across_px / blur_px;
  const double passed = 0.5 * std::erfc(-z / std::numbers::sqrt2);
  if (power == 0) return passed;
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
  const double first = z * passed + density;
  return power == 1 ? blur_px * first : blur_px * blur_px * (z * first + passed);
}

double TotalBlurVariance(double blur_px) { return blur_px * blur_px + 1.0 / 12.0; }

BlurredStep::BlurredStep(const Eigen::Vector2d& normal, double blur_px)
    : blur_px_(blur_px), per_blur_(1 / blur_px) {
  assert(blur_px > 0);
  const double wide = normal.cwiseAbs().maxCoeff();
  const double thin = std::max(normal.cwiseAbs().minCoeff(), kThinnest);
  half_sum_ = 0.5 * (wide + thin);
  half_difference_ = 0.5 * (wide - thin);
  per_area_ = 1 / (wide * thin);
  reach_px_ = half_sum_ + kTail * blur_px;
}

StepSample BlurredStep::At(double across_px) const {
  if (across_px <= -reach_px_) return {};
  if (across_px >= reach_px_) return {1, 0, 0};
  const Integrals a = Interpolate((across_px + half_sum_) * per_blur_);
  const Integrals b = Interpolate((across_px + half_difference_) * per_blur_);
  const Integrals c = Interpolate((across_px - half_difference_) * per_blur_);
  const Integrals d = Interpolate((across_px - half_sum_) * per_blur_);
  const double scale = per_area_ * blur_px_;
  return {scale * blur_px_ * (a.thrice - b.thrice - c.thrice + d.thrice),
          scale * (a.twice - b.twice - c.twice + d.twice),
          scale * (a.once - b.once - c.once + d.once)};
}

}  // namespace bladecurve
