// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace bladecurve {

// Light from stored grey values: linear[v] in [0, 1] for v = 0..255. Edges are located in linear
// light; a blurred edge found in encoded values is off by 0.15 to 1 px.
struct ToneCurve {
  std::array<float, 256> linear{};
  double gamma_sigma =
      0.15;  // standard uncertainty of the effective exponent; feeds the edges' common offset
};

// One grey level of sRGB: what is darker is as dark as far as a picture tells.
inline constexpr double kDarkestLight = 0.004;

// IEC 61966-2-1.
[[nodiscard]] ToneCurve SrgbToneCurve();

}  // namespace bladecurve
