// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/opening.h"

#include <cmath>

namespace bladecurve {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Opening MeasureOpening(const PlaneMap& map,
                       const Pivot& pivot,
                       const LocatedBlade& upper,
                       const LocatedBlade& lower) {
  const auto in_plane = [&](const Vector2d& px) { return map.PlaneFromImage(px); };
  const auto angle = [&](const Vector2d& p, const Vector2d& u, const Vector2d& l) {
    const Vector2d a = in_plane(u) - in_plane(p);
    const Vector2d b = in_plane(l) - in_plane(p);
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  };
  Opening opening;
  opening.theta_rad = angle(pivot.point_px, upper.end.point_px, lower.end.point_px);
  const Vector2d a = (in_plane(upper.end.point_px) - in_plane(pivot.point_px)).normalized();
  const Vector2d b = (in_plane(lower.end.point_px) - in_plane(pivot.point_px)).normalized();
  opening.x_in_plane = (a + b).normalized();
  // First order, by differences of one pixel over the three points' coordinates.
  double variance = 0;
  const auto add = [&](const Matrix2d& covariance, const auto& moved) {
    Vector2d gradient;
    for (int k = 0; k < 2; ++k) gradient[k] = moved(Vector2d::Unit(k)) - opening.theta_rad;
    variance += gradient.dot(covariance * gradient);
  };
  add(pivot.covariance_px2, [&](const Vector2d& d) {
    return angle(pivot.point_px + d, upper.end.point_px, lower.end.point_px);
  });
  const double shared_px = upper.edge.common_sigma_px;
  add(EndCovariance(upper, shared_px), [&](const Vector2d& d) {
    return angle(pivot.point_px, upper.end.point_px + d, lower.end.point_px);
  });
  add(EndCovariance(lower, shared_px), [&](const Vector2d& d) {
    return angle(pivot.point_px, upper.end.point_px, lower.end.point_px + d);
  });
  const double out_of_both = angle(pivot.point_px,
                                   upper.end.point_px + upper.used.back().normal,
                                   lower.end.point_px + lower.used.back().normal) -
                             opening.theta_rad;
  variance += shared_px * shared_px * out_of_both * out_of_both;
  opening.sigma_rad = std::sqrt(variance);
  return opening;
}

}  // namespace bladecurve
