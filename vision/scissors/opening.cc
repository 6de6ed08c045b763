// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/opening.h"

#include <Eigen/Geometry>
#include <cmath>

#include "vision/image/cross.h"

namespace bladecurve {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Corners of the rays to the distal ends.
struct Rays {
  Vector2d pivot, upper, lower;

  [[nodiscard]] double Angle() const {
    const Vector2d a = upper - pivot, b = lower - pivot;
    return std::abs(std::atan2(Cross(a, b), a.dot(b)));
  }
  [[nodiscard]] Vector2d Halfway() const {
    return ((upper - pivot).normalized() + (lower - pivot).normalized()).normalized();
  }
  template <typename Map>
  [[nodiscard]] Rays Through(const Map& map) const {
    return {map(pivot), map(upper), map(lower)};
  }
};

// Where a camera slanted by that angle about a line in the picture would see from above what it
// sees at `px`.
Vector2d PlaceFromAbove(const Camera& camera,
                        const Vector2d& about,
                        double slant_rad,
                        const Vector2d& px) {
  const Vector2d middle_px = camera.k.topRightCorner<2, 1>();
  const double f = camera.focal_length_px();
  const Vector3d ray = Eigen::AngleAxisd(slant_rad, Vector3d(about.x(), about.y(), 0)) *
                       Vector3d(px.x() - middle_px.x(), px.y() - middle_px.y(), f);
  return f / ray.z() * ray.head<2>();
}

// To second order of the slant: of blades about the picture's middle nothing but foreshortening
// changes the angle. By symmetry slants about the line halfway between the rays and across it do so
// independently.
double ViewSigma(const Rays& seen_px, const Camera& camera) {
  const double seen_rad = seen_px.Angle();
  const Vector2d halfway = seen_px.Halfway();
  double variance = 0;
  for (const Vector2d& about : {halfway, Vector2d(halfway.unitOrthogonal())}) {
    const auto turned_by = [&](double slant_rad) {
      const auto from_above = [&](const Vector2d& px) {
        return PlaceFromAbove(camera, about, slant_rad, px);
      };
      return seen_px.Through(from_above).Angle() - seen_rad;
    };
    const double one_way = turned_by(kFreehandSlantRad), other_way = turned_by(-kFreehandSlantRad);
    const double first = (one_way - other_way) / 2, second = (one_way + other_way) / 2;
    variance += first * first + 2 * second * second;  // normally distributed slants
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
  const Rays seen_px{pivot.point_px, upper.end.point_px, lower.end.point_px};
  Opening opening;
  opening.theta_rad = seen_px.Through(in_plane).Angle();
  opening.x_in_plane = seen_px.Through(in_plane).Halfway();
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
  if (unknown_view) opening.view_sigma_rad = ViewSigma(seen_px, unknown_view->camera);
  return opening;
}

}  // namespace bladecurve
