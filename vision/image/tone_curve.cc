// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/tone_curve.h"

#include <cmath>

namespace bladecurve {

ToneCurve SrgbToneCurve() {
  ToneCurve curve;
  for (size_t v = 0; v < curve.linear.size(); ++v) {
    const double encoded = static_cast<double>(v) / 255.0;
    curve.linear[v] = static_cast<float>(
        encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
  }
  return curve;
}

ToneCurve ToThePower(const ToneCurve& curve, double exponent, double exponent_sigma) {
  ToneCurve power;
  for (size_t v = 0; v < curve.linear.size(); ++v)
    power.linear[v] = static_cast<float>(std::pow(curve.linear[v], exponent));
  power.exponent_sigma = exponent_sigma;
  return power;
}

}  // namespace bladecurve
