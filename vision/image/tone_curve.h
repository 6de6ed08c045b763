// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace bladecurve {

// Light from stored grey values: linear[v] in [0, 1] for v = 0..255. Edges are located in linear
// light; a blurred edge found in encoded values is off by 0.15 to 1 px.
struct ToneCurve {
  std::array<float, 256> linear{};
  // Standard uncertainty, relative, of the exponent; feeds the edges' common offset. Of cameras
  // whose curve is taken for sRGB: 0.15 of 2.2.
  double exponent_sigma = 0.07;
};

// One grey level of sRGB: what is darker is as dark as far as a picture tells.
inline constexpr double kDarkestLight = 0.004;

// IEC 61966-2-1.
[[nodiscard]] ToneCurve SrgbToneCurve();

// The light of `curve` to a power, relative to white.
[[nodiscard]] ToneCurve ToThePower(const ToneCurve& curve, double exponent, double exponent_sigma);

}  // namespace bladecurve
