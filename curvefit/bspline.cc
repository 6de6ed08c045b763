// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/bspline.h"

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
  for (int d = 1; d <= degree; ++d) {
    if (d == degree) Differentiate(space.knots, span, d, row.value, row.slope);
    RaiseDegree(space.knots, span, d, u, row.value);
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
