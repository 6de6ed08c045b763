// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision/scale/camera.h"

namespace bladecurve {

// What a PlaneMap is made of.
struct PlaneGeometry {
  Eigen::Matrix3d plane_from_undistorted =
      Eigen::Matrix3d::Identity();  // homography, mm from undistorted pixels
  Camera camera;                    // its lens bends undistorted to image pixels
};

// Image to mm in the plane of the cutting edges; lens distortion, tilt and blade height included.
// The plane frame is right-handed as the *stored* picture is seen (y up); its origin and direction
// are arbitrary.
class PlaneMap {
 public:
  // Uniform scale, no perspective, but for what the lens bends. Throws std::invalid_argument unless
  // mm_per_px is positive and finite.
  static PlaneMap Uniform(double mm_per_px,
                          double relative_sigma,
                          std::string source,
                          const Camera& lens = {});
  // Throws std::invalid_argument for a singular homography.
  static PlaneMap FromGeometry(const PlaneGeometry& geometry,
                               double relative_sigma,
                               std::string source);
  // The same map with these doubts about it.
  [[nodiscard]] PlaneMap WithWarnings(std::vector<std::string> warnings) const;

  [[nodiscard]] Eigen::Vector2d PlaneFromImage(const Eigen::Vector2d& image_px) const;
  [[nodiscard]] Eigen::Vector2d ImageFromPlane(const Eigen::Vector2d& plane_mm) const;
  [[nodiscard]] Eigen::Matrix2d JacobianAt(
      const Eigen::Vector2d& image_px) const;  // d plane / d image
  [[nodiscard]] double relative_sigma() const {
    return relative_sigma_;
  }  // of lengths in mm, standard
  [[nodiscard]] const std::string& source() const {
    return source_;
  }  // "mm-per-px", "marker", "card", "dpi", ...
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  [[nodiscard]] const PlaneGeometry& geometry() const { return geometry_; }

 private:
  PlaneMap() = default;

  PlaneGeometry geometry_;
  Eigen::Matrix3d undistorted_from_plane_ = Eigen::Matrix3d::Identity();
  double relative_sigma_ = 0;
  std::string source_;
  std::vector<std::string> warnings_;
};

}  // namespace bladecurve
