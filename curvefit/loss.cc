// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "curvefit/residuals.h"

namespace bladecurve {
namespace {

// Widths in sigma: 95 % efficient for Gaussian noise.
constexpr double kCauchy = 2.385;
constexpr double kTukey = 4.685;
constexpr double kSmall = 1e-4;  // below this r/width, value and slope are the identity to rounding

SoftResidual Huber(double r) {
  const double size = std::abs(r);
  const double value = std::sqrt(kHuber * (2 * size - kHuber));
  return {std::copysign(value, r), kHuber / value};
}

SoftResidual Cauchy(double r) {
  const double t = r / kCauchy;
  if (std::abs(t) < kSmall) return {r, 1};
  const double root = std::sqrt(std::log1p(t * t));
  return {std::copysign(kCauchy * root, r), std::abs(t) / ((1 + t * t) * root)};
}

SoftResidual Tukey(double r) {
  const double t = r / kTukey;
  if (std::abs(t) < kSmall) return {r, 1};
  if (std::abs(t) >= 1) return {std::copysign(kTukey / std::sqrt(3.0), r), 0};
  const double rest = 1 - t * t;
  const double root = std::sqrt((1 - rest * rest * rest) / 3);
  return {std::copysign(kTukey * root, r), std::abs(t) * rest * rest / root};
}

}  // namespace

Loss LossNamed(const std::string& name) {
  if (name == "none") return Loss::kNone;
  if (name == "huber") return Loss::kHuber;
  if (name == "cauchy") return Loss::kCauchy;
  if (name == "tukey") return Loss::kTukey;
  throw std::invalid_argument("fit: loss is \"" + name +
                              "\"; it must be none, huber, cauchy or tukey");
}

SoftResidual SoftenLarge(Loss loss, double residual) {
  switch (loss) {
    case Loss::kHuber:
      return Huber(residual);
    case Loss::kCauchy:
      return Cauchy(residual);
    case Loss::kTukey:
      return Tukey(residual);
    case Loss::kNone:
      break;
  }
  return {residual, 1};
}

}  // namespace bladecurve
