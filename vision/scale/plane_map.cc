// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/plane_map.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace bladecurve {
namespace {

Eigen::Vector2d Project(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  return (homography * point.homogeneous()).hnormalized();
}

}  // namespace

PlaneMap PlaneMap::Uniform(double mm_per_px,
                           double relative_sigma,
                           std::string source,
                           const Camera& lens) {
  if (!(mm_per_px > 0) || !std::isfinite(mm_per_px)) {
    throw std::invalid_argument("PlaneMap: mm_per_px must be positive, not " +
                                std::to_string(mm_per_px));
  }
  PlaneGeometry geometry;
  geometry.plane_from_undistorted.diagonal() << mm_per_px, -mm_per_px, 1;
  geometry.camera = lens;
  return FromGeometry(geometry, relative_sigma, std::move(source));
}

PlaneMap PlaneMap::FromGeometry(const PlaneGeometry& geometry,
                                double relative_sigma,
                                std::string source) {
  const Eigen::Matrix3d& h = geometry.plane_from_undistorted;
  if (!h.allFinite() || h.determinant() == 0)
    throw std::invalid_argument("PlaneMap: singular homography");
  PlaneMap map;
  map.geometry_ = geometry;
  map.undistorted_from_plane_ = h.inverse();
  map.relative_sigma_ = relative_sigma;
  map.source_ = std::move(source);
  return map;
}

PlaneMap PlaneMap::WithWarnings(std::vector<std::string> warnings) const {
  PlaneMap map = *this;
  map.warnings_ = std::move(warnings);
  return map;
}

Eigen::Vector2d PlaneMap::PlaneFromImage(const Eigen::Vector2d& image_px) const {
  return Project(geometry_.plane_from_undistorted, Undistorted(geometry_.camera, image_px));
}

Eigen::Vector2d PlaneMap::ImageFromPlane(const Eigen::Vector2d& plane_mm) const {
  return Distorted(geometry_.camera, Project(undistorted_from_plane_, plane_mm));
}

Eigen::Matrix2d PlaneMap::JacobianAt(const Eigen::Vector2d& image_px) const {
  constexpr double kStepPx = 1e-3;  // error of the difference: curvature * 1e-6, rounding 1e-12
  Eigen::Matrix2d jacobian;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kStepPx * Eigen::Vector2d::Unit(axis);
    jacobian.col(axis) =
        (PlaneFromImage(image_px + step) - PlaneFromImage(image_px - step)) / (2 * kStepPx);
  }
  return jacobian;
}

}  // namespace bladecurve
