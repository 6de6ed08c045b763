// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_camera.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bladecurve::render {

Camera::Camera(const CameraSpec& spec, int width, int height) {
  const double focal_px = spec.distance_mm / spec.mm_per_px;
  truth_.k << focal_px, 0, 0.5 * (width - 1), 0, focal_px, 0.5 * (height - 1), 0, 0, 1;
  const Eigen::Vector3d backwards(std::sin(spec.tilt_rad) * std::cos(spec.tilt_azimuth_rad),
                                  std::sin(spec.tilt_rad) * std::sin(spec.tilt_azimuth_rad),
                                  std::cos(spec.tilt_rad));
  const Eigen::Vector3d forward = -backwards;
  const Eigen::Vector3d right =
      (Eigen::Vector3d::UnitX() - forward.x() * forward).normalized();  // world x stays level
  truth_.camera_from_world.row(0) = right;
  truth_.camera_from_world.row(1) = forward.cross(right);
  truth_.camera_from_world.row(2) = forward;
  center_mm_ = spec.distance_mm * backwards;
  truth_.world_in_camera_mm = -truth_.camera_from_world * center_mm_;
  truth_.k1 = spec.k1;
}

Eigen::Vector2d Camera::PixelFromWorld(const Eigen::Vector3d& world_mm) const {
  const Eigen::Vector3d p = truth_.camera_from_world * world_mm + truth_.world_in_camera_mm;
  const Eigen::Vector2d ideal = p.head<2>() / p.z();
  const Eigen::Vector2d bent = ideal * (1 + truth_.k1 * ideal.squaredNorm());
  return truth_.k(0, 0) * bent + truth_.k.block<2, 1>(0, 2);
}

Eigen::Vector2d Camera::WorldFromPixel(const Eigen::Vector2d& px, double height_mm) const {
  const Eigen::Vector2d bent = (px - truth_.k.block<2, 1>(0, 2)) / truth_.k(0, 0);
  const double bent_radius = bent.norm();
  double radius = bent_radius;
  if (truth_.k1 != 0) {
    constexpr int kNewtonSteps = 4;  // quadratic convergence from |k1 r^2| < 0.1
    for (int i = 0; i < kNewtonSteps; ++i) {
      const double error = radius * (1 + truth_.k1 * radius * radius) - bent_radius;
      if (error == 0) break;
      radius -= error / (1 + 3 * truth_.k1 * radius * radius);
    }
  }
  const double unbend = bent_radius > 0 ? radius / bent_radius : 1;
  const Eigen::Vector3d ray = truth_.camera_from_world.transpose() *
                              Eigen::Vector3d(bent.x() * unbend, bent.y() * unbend, 1);
  const double steps = (height_mm - center_mm_.z()) / ray.z();
  return (center_mm_ + steps * ray).head<2>();
}

}  // namespace bladecurve::render
