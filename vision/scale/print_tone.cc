// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/print_tone.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// In sharper pictures the JPEG's loss is as asymmetric as the tone curve: exponents of 0.75 to 0.97
// are seen where it is 1.
constexpr double kBlurPx = 0.7;

// What the scatter between cells of one marker does not show, as found on rendered markers.
constexpr double kOneMarker = 1.5;

// Of all markers: rendered by a path tracer and encoded as sRGB, they show exponents that differ by
// that; of the light that wanders in real paper, 0.02 to 0.07 is to be expected.
constexpr double kPrint = 0.08;

// No camera is as far from sRGB as that: something else is seen.
constexpr double kFarOff = 0.3;

bool Tells(const SeenMarker& marker) {
  return marker.blur_px >= kBlurPx && !marker.overexposed && std::isfinite(marker.tone.sigma) &&
         marker.tone.sigma > 0;
}

}  // namespace

ToneSeen ToneOfPrint(const std::vector<SeenMarker>& markers) {
  double sum = 0, weights = 0, square = 0, count = 0;
  for (const SeenMarker& marker : markers) {
    if (!Tells(marker)) continue;
    const double weight = std::pow(kOneMarker * marker.tone.sigma, -2),
                 off = marker.tone.exponent - 1;
    sum += weight * off;
    square += weight * off * off;
    weights += weight;
    ++count;
  }
  const double known = SrgbToneCurve().exponent_sigma;
  if (count == 0) return {1, known};
  const double seen = sum / weights;
  if (std::abs(seen) > kFarOff) return {1, known};
  const double scatter = count > 1 ? (square - seen * sum) / (count - 1) : 1;
  const double variance = std::max(scatter, 1.0) / weights + kPrint * kPrint;
  const double share = known * known / (known * known + variance);
  return {1 + share * seen, known * std::sqrt(1 - share)};
}

}  // namespace bladecurve
