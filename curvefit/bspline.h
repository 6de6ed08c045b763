// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace bladecurve {

inline constexpr int kMaxSplineDegree = 5;

// The B-splines of one degree over one clamped knot vector: a basis, no curve yet.
struct SplineSpace {
  int degree = 3;             // 1 to 5
  std::vector<double> knots;  // clamped, interior ones strictly increasing

  [[nodiscard]] int size() const { return static_cast<int>(knots.size()) - degree - 1; }
  [[nodiscard]] double lower() const { return knots.front(); }
  [[nodiscard]] double upper() const { return knots.back(); }
};

// The degree + 1 basis functions that are not zero at one place, with their derivatives.
struct BasisRow {
  int first = 0;  // index of the first of them
  std::array<double, kMaxSplineDegree + 1> value{}, slope{};
};

// Interior knots must lie strictly inside (lower, upper), increasing.
[[nodiscard]] SplineSpace ClampedSpace(int degree,
                                       double lower,
                                       double upper,
                                       const std::vector<double>& interior);

// The interior knots of a clamped space.
[[nodiscard]] std::vector<double> InteriorKnots(const SplineSpace& space);

// Beyond the ends the polynomials of the end spans go on.
[[nodiscard]] BasisRow EvalBasis(const SplineSpace& space, double u);

// The abscissae xi_j with u = sum xi_j B_j(u): the identity written as a spline.
[[nodiscard]] std::vector<double> GrevilleAbscissae(const SplineSpace& space);

}  // namespace bladecurve
