// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/opening.h"

#include <cmath>

#include "vision/image/cross.h"

namespace bladecurve {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

// Corners of the rays to the distal ends.
struct Rays {
  Vector2d pivot, upper, lower;

  [[nodiscard]] double Angle() const {
    const Vector2d a = upper - pivot, b = lower - pivot;
    return std::abs(std::atan2(Cross(a, b), a.dot(b)));
  }
  template <typename Map>
  [[nodiscard]] Rays Through(const Map& map) const {
    return {map(pivot), map(upper), map(lower)};
  }
};

// A camera slanted by small angles s sees at p (1 + s.p / f), from the picture's middle, what it
// would see at p from above.
double ViewSigma(const Rays& seen_px, const Camera& camera) {
  const Vector2d middle_px = camera.k.topRightCorner<2, 1>();
  double variance = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const Rays from_above = seen_px.Through([&](const Vector2d& px) -> Vector2d {
      const Vector2d p = px - middle_px;
      return (1 - kFreehandSlantRad * p[axis] / camera.focal_length_px()) * p;
    });
    variance += std::pow(from_above.Angle() - seen_px.Angle(), 2);
  }
  return std::sqrt(variance);
}

}  // namespace

Opening MeasureOpening(const PlaneMap& map,
                       const std::optional<CameraKnowledge>& unknown_view,
                       const Pivot& pivot,
                       const LocatedBlade& upper,
                       const LocatedBlade& lower) {
  const auto in_plane = [&](const Vector2d& px) { return map.PlaneFromImage(px); };
  const auto angle = [&](const Vector2d& p, const Vector2d& u, const Vector2d& l) {
    return Rays{p, u, l}.Through(in_plane).Angle();
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
  if (unknown_view) {
    opening.view_sigma_rad =
        ViewSigma({pivot.point_px, upper.end.point_px, lower.end.point_px}, unknown_view->camera);
  }
  return opening;
}

}  // namespace bladecurve
