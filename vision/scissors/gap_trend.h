// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "vision/pivot/edge_gap.h"

namespace bladecurve {

// What the gap follows over its middle, clear of crotch and tips, and how far it is off that
// everywhere.
struct Trend {
  GapCourse course;
  std::vector<double> off;
  double scatter = 0;  // over the middle
};

// By least squares, strays aside. A straight line (terms: 2) or a parabola (3).
[[nodiscard]] Trend TrendOf(const EdgeGap& gap, Eigen::Index terms);

// How many places of the gap at either end lie off its trend.
struct Parting {
  std::size_t tip = 0, crotch = 0;
  [[nodiscard]] double Count() const { return static_cast<double>(tip + crotch); }
};

// tolerance: of what is no parting, in the gap's units.
[[nodiscard]] Parting PartingFrom(const Trend& trend, double tolerance);

}  // namespace bladecurve
