// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/bspline.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <numeric>

namespace bladecurve {
namespace {

using Row = std::array<double, kMaxSplineDegree + 1>;

// Index i with knots[i] <= u < knots[i + 1], kept among the spans that are not empty.
int SpanOf(const SplineSpace& space, double u) {
  int span = space.degree;
  const int last = space.size() - 1;
  while (span < last && u >= space.knots[span + 1]) ++span;
  return span;
}

// One step of the Cox-de Boor recursion: from degree d - 1 to d, values in place.
void RaiseDegree(const std::vector<double>& knots, int span, int d, double u, Row& row) {
  double saved = 0;
  for (int j = 0; j < d; ++j) {
    const double right = knots[span + j + 1];
    const double left = knots[span + 1 - d + j];
    const double part = row[j] / (right - left);
    row[j] = saved + (right - u) * part;
    saved = (u - left) * part;
  }
  row[d] = saved;
}

// Derivative of the degree-d functions from those of degree d - 1.
void Differentiate(const std::vector<double>& knots, int span, int d, const Row& lower, Row& out) {
  double carried = 0;
  for (int j = 0; j < d; ++j) {
    const double part = d * lower[j] / (knots[span + j + 1] - knots[span + 1 - d + j]);
    out[j] = carried - part;
    carried = part;
  }
  out[d] = carried;
}

}  // namespace

SplineSpace ClampedSpace(int degree,
                         double lower,
                         double upper,
                         const std::vector<double>& interior) {
  SplineSpace space{degree, std::vector<double>(degree + 1, lower)};
  space.knots.insert(space.knots.end(), interior.begin(), interior.end());
  space.knots.insert(space.knots.end(), degree + 1, upper);
  return space;
}

std::vector<double> InteriorKnots(const SplineSpace& space) {
  return {space.knots.begin() + space.degree + 1, space.knots.end() - space.degree - 1};
}

BasisRow EvalBasis(const SplineSpace& space, double u) {
  const int span = SpanOf(space, u);
  const int degree = space.degree;
  BasisRow row;
  row.first = span - degree;
  row.value[0] = 1;
  Row slope_below{};  // derivatives of the functions one degree lower
  for (int d = 1; d <= degree; ++d) {
    if (d == degree) {
      Differentiate(space.knots, span, d, row.value, row.slope);
      Differentiate(space.knots, span, d, slope_below, row.curvature);
    } else if (d == degree - 1) {
      Differentiate(space.knots, span, d, row.value, slope_below);
    }
    RaiseDegree(space.knots, span, d, u, row.value);
  }
  return row;
}

BasisTable::BasisTable(const SplineSpace& space) : degree_(space.degree) {
  const int size = degree_ + 1;
  Eigen::MatrixXd powers(size, size);
  std::vector<double> nodes;
  for (int i = 0; i < size; ++i) {
    nodes.push_back(
        std::cos(std::numbers::pi * (i + 0.5) / size));  // Chebyshev's: well conditioned
    for (int k = 0; k < size; ++k) powers(i, k) = std::pow(nodes.back(), k);
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(powers);
  for (int first = 0; first + degree_ < space.size(); ++first) {
    const double begin = space.knots[first + degree_], end = space.knots[first + degree_ + 1];
    Span span{(begin + end) / 2, 2 / (end - begin)};
    Eigen::MatrixXd values(size, size);
    for (int i = 0; i < size; ++i) {
      const BasisRow row = EvalBasis(space, span.centre + nodes[i] / span.scale);
      for (int j = 0; j < size; ++j) values(i, j) = row.value[j];
    }
    const Eigen::MatrixXd coefficients = lu.solve(values);
    for (int k = 0; k < size; ++k) {
      for (int j = 0; j < size; ++j) span.powers[k][j] = coefficients(k, j);
    }
    spans_.push_back(span);
    if (first + degree_ + 1 < space.size()) ends_.push_back(end);
  }
}

BasisRow BasisTable::At(double u) const {
  size_t i = 0;
  while (i < ends_.size() && u >= ends_[i]) ++i;
  const Span& span = spans_[i];
  const double t = (u - span.centre) * span.scale;
  BasisRow row;
  row.first = static_cast<int>(i);
  // Horner's scheme for the value, the slope and half the curvature of all functions at once.
  for (int k = degree_; k >= 0; --k) {
    for (int j = 0; j <= kMaxSplineDegree; ++j) {
      row.curvature[j] = row.curvature[j] * t + row.slope[j];
      row.slope[j] = row.slope[j] * t + row.value[j];
      row.value[j] = row.value[j] * t + span.powers[k][j];
    }
  }
  for (int j = 0; j <= kMaxSplineDegree; ++j) {
    row.slope[j] *= span.scale;
    row.curvature[j] *= 2 * span.scale * span.scale;
  }
  return row;
}

std::vector<double> GrevilleAbscissae(const SplineSpace& space) {
  std::vector<double> abscissae(space.size());
  for (int j = 0; j < space.size(); ++j) {
    const auto first = space.knots.begin() + j + 1;
    abscissae[j] = std::accumulate(first, first + space.degree, 0.0) / space.degree;
  }
  return abscissae;
}

}  // namespace bladecurve
