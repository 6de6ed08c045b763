// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace bladecurve {

// Logarithms of blue and red over green: shade leaves them, ambient light shifts them a little.
using Chroma = Eigen::Vector2d;

// bgr: linear light, 0 to 1.
[[nodiscard]] inline Chroma ChromaOf(const Eigen::Vector3d& bgr) {
  constexpr double kDarkest = 1e-3;  // three grey levels
  const double green = std::log(bgr[1] + kDarkest);
  return {std::log(bgr[0] + kDarkest) - green, std::log(bgr[2] + kDarkest) - green};
}

}  // namespace bladecurve
