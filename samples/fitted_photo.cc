// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/fitted_photo.h"

#include <Eigen/Geometry>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// +y of the blade frame: 90 degrees counter-clockwise from `axis_px` as the viewer sees it, y down.
Vector2d UpwardsFrom(const Vector2d& axis_px) { return {axis_px.y(), -axis_px.x()}; }

Vector2d PxFromMm(const Vector2d& vector_mm, const Vector2d& axis_px, double mm_per_px) {
  return (vector_mm.x() * axis_px + vector_mm.y() * UpwardsFrom(axis_px)) / mm_per_px;
}

}  // namespace

FittedPhoto ApplyPose(const PhotoMeasurement& photo, const FittedPose& pose) {
  FittedPhoto fitted;
  fitted.pivot_px = photo.pivot_px + PxFromMm(pose.pivot_mm, photo.axis_px, photo.mm_per_px);
  fitted.pivot_sigma_px = pose.pivot_sigma_mm / photo.mm_per_px;
  fitted.axis_px = std::cos(pose.axis_rad) * photo.axis_px +
                   std::sin(pose.axis_rad) * UpwardsFrom(photo.axis_px);
  fitted.theta_rad = pose.theta_rad;
  fitted.theta_sigma_rad = pose.theta_sigma_rad;
  // A scale that was given exactly stays as it was typed, whatever the solver's last digits.
  const bool exact = photo.edges.scale_relative_sigma == 0;
  const double grown = exact ? 1 : 1 + pose.scale_relative;
  fitted.mm_per_px = photo.mm_per_px * grown;
  const Eigen::Matrix2d blade_from_edges =
      grown * Eigen::Rotation2Dd(-pose.axis_rad).toRotationMatrix();
  fitted.upper_edge_mm.reserve(photo.upper_edge_mm.size());
  for (const Vector2d& point_mm : photo.upper_edge_mm) {
    fitted.upper_edge_mm.push_back(blade_from_edges * (point_mm - pose.pivot_mm));
  }
  return fitted;
}

std::vector<Vector2d> FittedEdgePx(const PhotoMeasurement& photo,
                                   const FittedPhoto& fitted,
                                   const BladeCurve& curve) {
  std::vector<Vector2d> edge_px;
  edge_px.reserve(photo.upper_edge_px.size());
  for (std::size_t i = 0; i < photo.upper_edge_px.size(); ++i) {
    const Vector2d& at_mm = fitted.upper_edge_mm[i];
    const double residual_mm = curve.Eval(at_mm.x(), fitted.theta_rad).phi_mm - at_mm.y();
    edge_px.push_back(photo.upper_edge_px[i] +
                      PxFromMm({0, residual_mm}, fitted.axis_px, photo.mm_per_px));
  }
  return edge_px;
}

}  // namespace bladecurve
