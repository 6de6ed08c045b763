// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/span_table.h"

namespace bladecurve {
namespace {

using Functions = std::array<Powers, kMaxSplineDegree + 1>;

// (constant + factor t) times a polynomial whose degree leaves room for one more.
Powers TimesLinear(const Powers& polynomial, double constant, double factor) {
  Powers product{};
  for (size_t k = 0; k < product.size(); ++k) {
    product[k] = constant * polynomial[k] + (k > 0 ? factor * polynomial[k - 1] : 0);
  }
  return product;
}

Powers Sum(const Powers& a, const Powers& b) {
  Powers sum{};
  for (size_t k = 0; k < sum.size(); ++k) sum[k] = a[k] + b[k];
  return sum;
}

// One step of the Cox-de Boor recursion, as in EvalBasis, with polynomials of t for values.
void RaiseDegree(
    const std::vector<double>& knots, int knot, int d, const Span& span, Functions& row) {
  const double u_by_t = 1 / span.scale;
  Powers saved{};
  for (int j = 0; j < d; ++j) {
    const double right = knots[knot + j + 1], left = knots[knot + 1 - d + j];
    const double width = right - left;
    const Powers function = row[j];
    row[j] = Sum(saved, TimesLinear(function, (right - span.centre) / width, -u_by_t / width));
    saved = TimesLinear(function, (span.centre - left) / width, u_by_t / width);
  }
  row[d] = saved;
}

}  // namespace

std::vector<Span> SpansOf(const SplineSpace& space) {
  std::vector<Span> spans;
  for (int knot = space.degree; knot < space.size(); ++knot) {
    Span span{space.knots[knot], space.knots[knot + 1]};
    span.centre = (span.begin + span.end) / 2;
    span.scale = 2 / (span.end - span.begin);
    span.basis[0][0] = 1;
    for (int d = 1; d <= space.degree; ++d) RaiseDegree(space.knots, knot, d, span, span.basis);
    spans.push_back(span);
  }
  return spans;
}

Eigen::MatrixXd BasisOf(const Span& span, int degree) {
  Eigen::MatrixXd basis(degree + 1, degree + 1);
  for (int j = 0; j <= degree; ++j) {
    for (int k = 0; k <= degree; ++k) basis(k, j) = span.basis[j][k];
  }
  return basis;
}

std::vector<Piece> PiecesOf(const std::vector<Span>& spans,
                            int degree,
                            const Eigen::VectorXd& coefficients) {
  std::vector<Piece> pieces(spans.size());
  for (size_t i = 0; i < spans.size(); ++i) {
    Piece& piece = pieces[i];
    for (int j = 0; j <= degree; ++j) {
      const double c = coefficients(static_cast<Eigen::Index>(i) + j);
      for (int k = 0; k <= degree; ++k) piece.value[k] += c * spans[i].basis[j][k];
    }
    for (int k = 0; k < degree; ++k) piece.slope[k] = (k + 1) * spans[i].scale * piece.value[k + 1];
  }
  return pieces;
}

}  // namespace bladecurve
