// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/blade_frame.h"

#include <Eigen/Dense>
#include <cmath>

namespace bladecurve {

using Eigen::Matrix2d;
using Eigen::Vector2d;

BladeFrame::BladeFrame(const PlaneMap& map, const Vector2d& pivot_px, const Vector2d& x_in_plane)
    : map_(map), pivot_px_(pivot_px), pivot_in_plane_(map.PlaneFromImage(pivot_px)) {
  frame_from_plane_ << x_in_plane.x(), x_in_plane.y(), -x_in_plane.y(), x_in_plane.x();
}

Vector2d BladeFrame::FromImage(const Vector2d& image_px) const {
  return frame_from_plane_ * (map_.PlaneFromImage(image_px) - pivot_in_plane_);
}

EdgePoint BladeFrame::FromImage(const Vector2d& image_px,
                                const Vector2d& normal_px,
                                double sigma_px) const {
  // A step e along the image normal n moves the edge by e / |J^-T n| along its normal in the plane.
  const Matrix2d jacobian = frame_from_plane_ * map_.JacobianAt(image_px);
  const Vector2d normal = jacobian.inverse().transpose() * normal_px;
  EdgePoint point;
  point.point_mm = FromImage(image_px);
  point.normal = normal.normalized();
  point.sigma_mm = sigma_px / normal.norm();
  return point;
}

LocatedPoint BladeFrame::FromImage(const Vector2d& image_px, const Matrix2d& covariance_px2) const {
  const Matrix2d jacobian = frame_from_plane_ * map_.JacobianAt(image_px);
  return {FromImage(image_px), jacobian * covariance_px2 * jacobian.transpose()};
}

Vector2d BladeFrame::axis_px() const {
  const Matrix2d jacobian = frame_from_plane_ * map_.JacobianAt(pivot_px_);
  return (jacobian.inverse() * Vector2d::UnitX()).normalized();
}

double BladeFrame::MmPerPxAt(const Vector2d& image_px) const {
  return (map_.JacobianAt(image_px) * axis_px()).norm();
}

double BladeFrame::mm_per_px() const { return MmPerPxAt(pivot_px_); }

double BladeFrame::mm_per_px_sigma(const Matrix2d& pivot_covariance_px2) const {
  Vector2d gradient;  // mm/px^2; perspective changes the scale smoothly, so 1 px is small enough
  for (int k = 0; k < 2; ++k) {
    const Vector2d step = Vector2d::Unit(k);
    gradient[k] = 0.5 * (MmPerPxAt(pivot_px_ + step) - MmPerPxAt(pivot_px_ - step));
  }
  return std::hypot(map_.relative_sigma() * mm_per_px(),
                    std::sqrt(gradient.dot(pivot_covariance_px2 * gradient)));
}

}  // namespace bladecurve
