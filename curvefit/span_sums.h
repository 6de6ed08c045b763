// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "curvefit/bspline.h"

namespace bladecurve {

// Sums over the points of one span of all products of the columns
//   w, w t, ..., w t^degree, and `Extra` more.
// The basis functions of a span are polynomials of t, so the sums by basis function follow from
// these when all points are in: less work at each point, and the same normal equations.
template <int Degree, int Extra>
class SpanSums {
 public:
  static constexpr int kSize = Degree + 1 + Extra;

  void Add(double t, double w, const std::array<double, Extra>& extra) {
    std::array<double, Degree + 1> column;
    column[0] = w;
    for (int k = 1; k <= Degree; ++k) column[k] = column[k - 1] * t;
    for (int m = 0; m <= 2 * Degree; ++m) powers_[m] += column[m / 2] * column[m - m / 2];
    for (int e = 0; e < Extra; ++e) {
      for (int k = 0; k <= Degree; ++k) mixed_[e][k] += extra[e] * column[k];
      for (int f = 0; f <= e; ++f) extras_[e][f] += extra[e] * extra[f];
    }
  }

  // (kSize, kSize); of a size known when it runs: what is made of it once a span is not worth
  // unrolling for every degree.
  [[nodiscard]] Eigen::MatrixXd AllProducts() const {
    Eigen::MatrixXd all(kSize, kSize);
    for (int i = 0; i <= Degree; ++i) {
      for (int j = 0; j <= Degree; ++j) all(i, j) = powers_[i + j];
    }
    for (int e = 0; e < Extra; ++e) {
      const int row = Degree + 1 + e;
      for (int k = 0; k <= Degree; ++k) all(row, k) = all(k, row) = mixed_[e][k];
      for (int f = 0; f <= e; ++f) {
        all(row, Degree + 1 + f) = all(Degree + 1 + f, row) = extras_[e][f];
      }
    }
    return all;
  }

 private:
  std::array<double, 2 * Degree + 1> powers_{};
  std::array<std::array<double, Degree + 1>, Extra> mixed_{};
  std::array<std::array<double, Extra>, Extra> extras_{};
};

}  // namespace bladecurve
