// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace bladecurve {

// Of two vectors in a plane: positive where b lies anticlockwise of a, x to the right and y up.
[[nodiscard]] inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace bladecurve
