// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/model/test_blades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace bladecurve {
namespace {

std::array<double, 6> Values(const CurveSample& s) {
  return {s.phi_mm,
          s.phi_x,
          s.phi_theta_mm_per_rad,
          s.phi_xx_per_mm,
          s.phi_xtheta_per_rad,
          s.phi_thetatheta_mm_per_rad2};
}

// The basis function B_{i,degree}(u); the last span is closed.
long double Basis(const std::vector<double>& t, std::size_t i, int degree, long double u) {
  if (degree == 0) {
    const bool last = t[i] < t[i + 1] && t[i + 1] == t.back();
    return u >= t[i] && (u < t[i + 1] || (last && u <= t[i + 1])) ? 1 : 0;
  }
  const auto p = static_cast<std::size_t>(degree);
  const long double left = static_cast<long double>(t[i + p]) - t[i];
  const long double right = static_cast<long double>(t[i + p + 1]) - t[i + 1];
  long double value = 0;
  if (left > 0) value += (u - t[i]) / left * Basis(t, i, degree - 1, u);
  if (right > 0) value += (t[i + p + 1] - u) / right * Basis(t, i + 1, degree - 1, u);
  return value;
}

long double BasisDerivative(
    const std::vector<double>& t, std::size_t i, int degree, int order, long double u) {
  if (order == 0) return Basis(t, i, degree, u);
  if (degree == 0) return 0;
  const auto p = static_cast<std::size_t>(degree);
  const long double left = static_cast<long double>(t[i + p]) - t[i];
  const long double right = static_cast<long double>(t[i + p + 1]) - t[i + 1];
  long double value = 0;
  if (left > 0) value += degree / left * BasisDerivative(t, i, degree - 1, order - 1, u);
  if (right > 0) value -= degree / right * BasisDerivative(t, i + 1, degree - 1, order - 1, u);
  return value;
}

}  // namespace

RigidSpline RandomSpline(std::mt19937& random, int degree, int num_spans, double waviness_mm) {
  RigidSpline spline;
  spline.degree = degree;
  std::vector<double> inner;
  for (int i = 1; i < num_spans; ++i) inner.push_back(Uniform(random, 15, 105));
  std::sort(inner.begin(), inner.end());
  spline.knots_mm.assign(static_cast<std::size_t>(degree) + 1, 10);
  spline.knots_mm.insert(spline.knots_mm.end(), inner.begin(), inner.end());
  spline.knots_mm.insert(spline.knots_mm.end(), static_cast<std::size_t>(degree) + 1, 110);
  const int coefficients = num_spans + degree;
  for (int i = 0; i < coefficients; ++i) {
    const double on_slope = 5.0 * (coefficients - 1 - i) / (coefficients - 1);
    spline.coefficients_mm.push_back(on_slope + Uniform(random, -waviness_mm, waviness_mm));
  }
  return spline;
}

BladeCurve RandomBlade(std::mt19937& random) {
  const CurveDomain domain = {15, 105, Uniform(random, 0, 0.1), Uniform(random, 0.5, 1.2)};
  if (random() % 4 == 0) {
    return {TaperedRectangle{
                Uniform(random, -20, 5), Uniform(random, 0, 0.3), Uniform(random, 0.4, 1.1)},
            domain};
  }
  const int degree = 1 + static_cast<int>(random() % 5);
  const int spans = 1 + static_cast<int>(random() % 6);
  return {RandomSpline(random, degree, spans, 0.5), domain};
}

double LargestDifference(const CurveSample& a, const CurveSample& b) {
  double largest = 0;
  for (std::size_t i = 0; i < Values(a).size(); ++i) {
    largest =
        std::max(largest, std::abs(Values(a)[i] - Values(b)[i]) / (1 + std::abs(Values(a)[i])));
  }
  return largest;
}

bool SameBits(const CurveSample& a, const CurveSample& b) {
  const auto left = Values(a);
  const auto right = Values(b);
  return std::memcmp(left.data(), right.data(), sizeof(left)) == 0 && a.flags == b.flags;
}

SplineValue ReferenceSpline(const RigidSpline& spline, long double u) {
  SplineValue value = {0, 0, 0};
  for (std::size_t i = 0; i < spline.coefficients_mm.size(); ++i) {
    const long double c = spline.coefficients_mm[i];
    value.s += c * BasisDerivative(spline.knots_mm, i, spline.degree, 0, u);
    value.s1 += c * BasisDerivative(spline.knots_mm, i, spline.degree, 1, u);
    value.s2 += c * BasisDerivative(spline.knots_mm, i, spline.degree, 2, u);
  }
  return value;
}

}  // namespace bladecurve
