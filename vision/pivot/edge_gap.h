// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace bladecurve {

// An edge about a line: places along it, ever further, and distances from it towards the edge's own
// side.
struct EdgeAboutLine {
  std::vector<double> along, aside;
};

// How much further from the line the first edge lies than the second, at those places of the first
// that the second has on both sides.
struct EdgeGap {
  std::vector<double> along, apart;
};
[[nodiscard]] EdgeGap GapBetween(const EdgeAboutLine& first, const EdgeAboutLine& second);

// What a gap follows: a polynomial of the place along the line, counted from `origin` in `length`s.
struct GapCourse {
  double origin = 0, length = 1;
  Eigen::Vector3d powers = Eigen::Vector3d::Zero();

  [[nodiscard]] double At(double along) const { return powers.dot(PowersAt(along)); }
  // Least squares over the gap's places for which counts(index): a straight line (terms: 2) or a
  // parabola (3).
  void Fit(const EdgeGap& gap, Eigen::Index terms, const std::function<bool(std::size_t)>& counts);

 private:
  [[nodiscard]] Eigen::Vector3d PowersAt(double along) const;
};

}  // namespace bladecurve
