// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace bladecurve {

// Covariance with different sigmas along and across a unit direction.
[[nodiscard]] inline Eigen::Matrix2d AlongAcross(const Eigen::Vector2d& along,
                                                 double along_sigma,
                                                 double across_sigma) {
  const Eigen::Vector2d across(-along.y(), along.x());
  return along_sigma * along_sigma * along * along.transpose() +
         across_sigma * across_sigma * across * across.transpose();
}

}  // namespace bladecurve
