// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vision/edge_points.h"
#include "vision/scale/plane_map.h"

namespace bladecurve {

// The frame of EdgePoints within the plane of the photograph: origin at the pivot, +x along the
// symmetry line.
class BladeFrame {
 public:
  // x_in_plane: unit.
  BladeFrame(const PlaneMap& map,
             const Eigen::Vector2d& pivot_px,
             const Eigen::Vector2d& x_in_plane);

  [[nodiscard]] Eigen::Vector2d FromImage(const Eigen::Vector2d& image_px) const;
  [[nodiscard]] EdgePoint FromImage(const Eigen::Vector2d& image_px,
                                    const Eigen::Vector2d& normal_px,
                                    double sigma_px) const;
  [[nodiscard]] LocatedPoint FromImage(const Eigen::Vector2d& image_px,
                                       const Eigen::Matrix2d& covariance_px2) const;

  [[nodiscard]] Eigen::Vector2d axis_px() const;  // unit direction of +x in the image, at the pivot
  [[nodiscard]] double mm_per_px() const;         // along the axis, at the pivot
  // Its standard uncertainty: the map's own, and in a slanting view that of where the pivot is.
  [[nodiscard]] double mm_per_px_sigma(const Eigen::Matrix2d& pivot_covariance_px2) const;

 private:
  // Along the axis, at this place.
  [[nodiscard]] double MmPerPxAt(const Eigen::Vector2d& image_px) const;

  const PlaneMap& map_;
  Eigen::Vector2d pivot_px_;
  Eigen::Vector2d pivot_in_plane_;
  Eigen::Matrix2d frame_from_plane_;  // a rotation
};

}  // namespace bladecurve
