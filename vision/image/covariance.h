// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace bladecurve {

// Covariance with different sigmas along and across a unit direction.
[[nodiscard]] inline Eigen::Matrix2d AlongAcross(const Eigen::Vector2d& along,
                                                 double along_sigma,
                                                 double across_sigma) {
  const Eigen::Vector2d across(-along.y(), along.x());
  return along_sigma * along_sigma * along * along.transpose() +
         across_sigma * across_sigma * across * across.transpose();
}

// Of a vector with that covariance, its square in standard uncertainties: chi-square of its two
// coordinates.
[[nodiscard]] inline double ChiSquare(const Eigen::Vector2d& vector,
                                      const Eigen::Matrix2d& covariance) {
  return vector.dot(covariance.inverse() * vector);
}

// The largest standard uncertainty in any direction.
[[nodiscard]] inline double LargestSigma(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * covariance.trace();
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return std::sqrt(mean + std::hypot(half_difference, covariance(0, 1)));
}

}  // namespace bladecurve
