// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curvefit/fit.h"
#include "vision/measure.h"

namespace bladecurve {

// One photograph with the pose that the fit gave it: phi of the fitted curve at theta_rad, drawn in
// the frame (pivot_px, axis_px, mm_per_px), lies on the located edge. Pixels are displayed pixels.
struct FittedPhoto {
  Eigen::Vector2d pivot_px;
  double pivot_sigma_px = 0;
  Eigen::Vector2d axis_px;  // unit image direction of +x
  double theta_rad = 0, theta_sigma_rad = 0;
  double mm_per_px = 0;                        // along the axis, at the pivot
  std::vector<Eigen::Vector2d> upper_edge_mm;  // in the blade frame; one a point of upper_edge_px
};

// Moves what vision measured by the motion and scale of `pose`. The shift is small, so the
// similarity at the pivot maps it to pixels.
[[nodiscard]] FittedPhoto ApplyPose(const PhotoMeasurement& photo, const FittedPose& pose);

// The fitted edge beside each located point of the upper edge, in pixels: the point moved along y
// by its residual. Only residuals pass through the similarity at the pivot, so tilt does not bend
// the curve.
[[nodiscard]] std::vector<Eigen::Vector2d> FittedEdgePx(const PhotoMeasurement& photo,
                                                        const FittedPhoto& fitted,
                                                        const BladeCurve& curve);

}  // namespace bladecurve
