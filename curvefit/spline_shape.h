// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curvefit/bspline.h"

namespace bladecurve {

// The upper distal end in its blade's frame. zero: the opening that a given theta has where ours is
// 0.
[[nodiscard]] Eigen::Vector2d EndInBlade(double reach, double zero);
[[nodiscard]] Eigen::Matrix2d EndJacobian(double reach, double zero);

// The coefficients of a spline that passes through an end point: those of a spline T whose last one
// is 0 and whose others are free, sheared.
//   s(u) = T(u) + u (end_v - T(end_u)) / end_u
struct SplineCoefficients {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;  // by the free ones, end_u, end_v
};
[[nodiscard]] SplineCoefficients CoefficientsOf(const SplineSpace& space,
                                                const double* free,
                                                const Eigen::Vector2d& end);

// Coefficients of the splines through given values at the Greville abscissae, a column each: always
// solvable.
[[nodiscard]] Eigen::MatrixXd SplineThrough(const SplineSpace& space,
                                            const Eigen::MatrixXd& values);

// The free coefficients of a spline.
[[nodiscard]] std::vector<double> FreeCoefficients(const SplineSpace& space,
                                                   const Eigen::VectorXd& coefficients);

}  // namespace bladecurve
