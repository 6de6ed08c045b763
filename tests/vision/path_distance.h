// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bladecurve {

// From a point to the nearest place of a polyline, px.
inline double DistanceToPath(const Eigen::Vector2d& point,
                             const std::vector<Eigen::Vector2d>& path) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d step = path[i] - path[i - 1];
    const double t = std::clamp((point - path[i - 1]).dot(step) / step.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - path[i - 1] - t * step).norm());
  }
  return least;
}

// Root mean square over points; NaN where there are none.
inline double RmsToPath(const std::vector<Eigen::Vector2d>& points,
                        const std::vector<Eigen::Vector2d>& path) {
  double squares = 0;
  for (const Eigen::Vector2d& point : points) squares += std::pow(DistanceToPath(point, path), 2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

}  // namespace bladecurve
