// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "curvefit/bspline.h"

namespace bladecurve {

// Signed orthogonal distance of a point from the edge v = s(u), and its derivatives. To first order
// in the distance, d = (v - s) cos, cos = 1/sqrt(1 + s'^2); the next term is d^2 s''/2, 1e-5 mm for
// d = 0.05 mm and a radius of 100 mm.
struct SplineDistance {
  double d = 0;
  double d_u = 0, d_v = 0;
  std::array<double, kMaxSplineDegree + 1> d_c{};  // by coefficients first, first + 1, ...
  int first = 0;
};
// Of the point (u, v); `row` holds the basis functions at u.
[[nodiscard]] SplineDistance DistanceFrom(
    const BasisRow& row, int degree, const double* coefficients, double v, double cosine);

// s' at the place of the row.
[[nodiscard]] double SlopeAt(const BasisRow& row, int degree, const double* coefficients);

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

// The free coefficients of a spline.
[[nodiscard]] std::vector<double> FreeCoefficients(const SplineSpace& space,
                                                   const Eigen::VectorXd& coefficients);

}  // namespace bladecurve
