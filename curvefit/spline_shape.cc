// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/spline_shape.h"

#include <Eigen/LU>
#include <cmath>

namespace bladecurve {

Eigen::Vector2d EndInBlade(double reach, double zero) {
  return {reach, -reach * std::tan(zero / 2)};
}

Eigen::Matrix2d EndJacobian(double reach, double zero) {
  const double half = std::tan(zero / 2);
  return Eigen::Matrix2d{{1, 0}, {-half, -0.5 * reach * (1 + half * half)}};
}

SplineCoefficients CoefficientsOf(const SplineSpace& space,
                                  const double* free,
                                  const Eigen::Vector2d& end) {
  const int n = space.size();
  Eigen::VectorXd t = Eigen::VectorXd::Zero(n);
  for (int j = 0; j < n - 1; ++j) t(j) = free[j];
  const BasisRow row = EvalBasis(space, end.x());
  Eigen::VectorXd basis = Eigen::VectorXd::Zero(n);
  double slope = 0;
  for (int j = 0; j <= space.degree; ++j) {
    basis(row.first + j) = row.value[j];
    slope += row.slope[j] * t(row.first + j);
  }
  const std::vector<double> abscissae = GrevilleAbscissae(space);
  const Eigen::VectorXd along = Eigen::Map<const Eigen::VectorXd>(abscissae.data(), n) / end.x();
  const double lift = end.y() - basis.dot(t);
  SplineCoefficients c;
  c.value = t + along * lift;
  c.jacobian = Eigen::MatrixXd::Zero(n, n + 1);
  c.jacobian.leftCols(n - 1).setIdentity();
  c.jacobian.leftCols(n - 1) -= along * basis.head(n - 1).transpose();
  c.jacobian.col(n - 1) = -along * (slope + lift / end.x());
  c.jacobian.col(n) = along;
  return c;
}

Eigen::MatrixXd SplineThrough(const SplineSpace& space, const Eigen::MatrixXd& values) {
  const std::vector<double> places = GrevilleAbscissae(space);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(space.size(), space.size());
  for (int i = 0; i < space.size(); ++i) {
    const BasisRow row = EvalBasis(space, places[i]);
    for (int j = 0; j <= space.degree; ++j) basis(i, row.first + j) = row.value[j];
  }
  return basis.partialPivLu().solve(values);
}

std::vector<double> FreeCoefficients(const SplineSpace& space,
                                     const Eigen::VectorXd& coefficients) {
  const int n = space.size();
  const std::vector<double> xi = GrevilleAbscissae(space);
  const double slope = coefficients(n - 1) / xi[n - 1];
  std::vector<double> free;
  for (int j = 0; j < n - 1; ++j) free.push_back(coefficients(j) - slope * xi[j]);
  return free;
}

}  // namespace bladecurve
