// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/camera.h"

#include <Eigen/LU>
#include <algorithm>

namespace bladecurve {
namespace {

bool IsPinhole(const Camera& camera) {
  return std::all_of(
      camera.distortion.begin(), camera.distortion.end(), [](double d) { return d == 0; });
}

Eigen::Vector2d Normalised(const Camera& camera, const Eigen::Vector2d& px) {
  const double y = (px.y() - camera.k(1, 2)) / camera.k(1, 1);
  return {(px.x() - camera.k(0, 2) - camera.k(0, 1) * y) / camera.k(0, 0), y};
}

Eigen::Vector2d Pixel(const Camera& camera, const Eigen::Vector2d& p) {
  return {camera.k(0, 0) * p.x() + camera.k(0, 1) * p.y() + camera.k(0, 2),
          camera.k(1, 1) * p.y() + camera.k(1, 2)};
}

// Radial and tangential model of Brown, with OpenCV's coefficients.
Eigen::Vector2d Bend(const std::array<double, 4>& d, const Eigen::Vector2d& p) {
  const auto [k1, k2, p1, p2] = d;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * k2);
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y)};
}

Eigen::Matrix2d BendJacobian(const std::array<double, 4>& d, const Eigen::Vector2d& p) {
  const auto [k1, k2, p1, p2] = d;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * k2), slope = 2 * k1 + 4 * k2 * r2;
  Eigen::Matrix2d jacobian;
  jacobian << radial + x * x * slope + 2 * p1 * y + 6 * p2 * x,
      x * y * slope + 2 * p1 * x + 2 * p2 * y, x * y * slope + 2 * p2 * y + 2 * p1 * x,
      radial + y * y * slope + 2 * p2 * x + 6 * p1 * y;
  return jacobian;
}

}  // namespace

Camera CentredCamera(double focal_length_px, int width, int height) {
  Camera camera;
  camera.k << focal_length_px, 0, 0.5 * (width - 1), 0, focal_length_px, 0.5 * (height - 1), 0, 0,
      1;
  return camera;
}

Eigen::Vector2d Undistorted(const Camera& camera, const Eigen::Vector2d& image_px) {
  if (IsPinhole(camera)) return image_px;
  constexpr int kMaxSteps = 20;  // Newton converges in four; more only outside the lens's own field
  const Eigen::Vector2d seen = Normalised(camera, image_px);
  Eigen::Vector2d straight = seen;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::Vector2d error = Bend(camera.distortion, straight) - seen;
    const Eigen::Vector2d correction = BendJacobian(camera.distortion, straight).inverse() * error;
    straight -= correction;
    if (correction.squaredNorm() < 1e-26) break;
  }
  return Pixel(camera, straight);
}

Eigen::Vector2d Distorted(const Camera& camera, const Eigen::Vector2d& undistorted_px) {
  if (IsPinhole(camera)) return undistorted_px;
  return Pixel(camera, Bend(camera.distortion, Normalised(camera, undistorted_px)));
}

}  // namespace bladecurve
