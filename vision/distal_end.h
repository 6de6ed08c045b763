// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace bladecurve {

// Where a cutting edge begins to round off into the tip.
struct DistalEnd {
  Eigen::Vector2d point_px;
  std::size_t index =
      0;  // first point of the edge that belongs to the tip; the size of the edge if none does
  double along_sigma_px = 0;  // standard uncertainty along the edge
};

// `edge` runs from the crotch to the tip, points about evenly spaced; `sigma_px` is the scatter of
// one point across it. Least squares over the place t0 where the residual from the smooth edge
// starts to grow as (t - t0)^2 / (2 R). Fewer than 12 points: the last point, with the length of
// the edge as its uncertainty.
[[nodiscard]] DistalEnd FindDistalEnd(const std::vector<Eigen::Vector2d>& edge, double sigma_px);

}  // namespace bladecurve
