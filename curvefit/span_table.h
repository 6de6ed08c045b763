// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <type_traits>
#include <vector>

#include "curvefit/bspline.h"

namespace bladecurve {

// Coefficients of 1, t, t^2, ...; those beyond the degree are 0.
using Powers = std::array<double, kMaxSplineDegree + 1>;

template <int Degree>
[[nodiscard]] inline double Horner(const Powers& powers, double t) {
  double value = powers[Degree];
  for (int k = Degree - 1; k >= 0; --k) value = value * t + powers[k];
  return value;
}

// One span of a spline space: t = (u - centre) * scale, within +-1. Beyond the ends of the space
// the first and the last span go on.
struct Span {
  double begin = 0, end = 0, centre = 0, scale = 1;
  // Of t; element j is the basis function of the coefficient (index of the span) + j.
  std::array<Powers, kMaxSplineDegree + 1> basis{};
};
[[nodiscard]] std::vector<Span> SpansOf(const SplineSpace& space);

// The basis functions of a span: powers of t by functions.
[[nodiscard]] Eigen::MatrixXd BasisOf(const Span& span, int degree);

// Index of the span of u; fast for places in order, where `hint` is the answer for the last one.
[[nodiscard]] inline size_t FindSpan(const std::vector<Span>& spans, double u, size_t hint) {
  while (hint + 1 < spans.size() && u >= spans[hint].end) ++hint;
  while (hint > 0 && u < spans[hint].begin) --hint;
  return hint;
}

// A spline in one span: itself and its derivative by u, as polynomials of t.
struct Piece {
  Powers value{}, slope{};
};
[[nodiscard]] std::vector<Piece> PiecesOf(const std::vector<Span>& spans,
                                          int degree,
                                          const Eigen::VectorXd& coefficients);

// Calls `work` with the degree as a constant of the type: loops over it are then unrolled.
template <typename Work>
auto WithDegree(int degree, const Work& work) {
  static_assert(kMaxSplineDegree == 5);
  switch (degree) {
    case 1:
      return work(std::integral_constant<int, 1>());
    case 2:
      return work(std::integral_constant<int, 2>());
    case 3:
      return work(std::integral_constant<int, 3>());
    case 4:
      return work(std::integral_constant<int, 4>());
    default:
      return work(std::integral_constant<int, 5>());
  }
}

}  // namespace bladecurve
