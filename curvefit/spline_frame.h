// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "curvefit/bspline.h"
#include "curvefit/fit_data.h"

namespace bladecurve {

// While a fit runs, the spline does not move with the blade's frame but stays where the upper edge
// of the first photograph is. Else its knots, and the direction in which it is a graph, would tie
// the pivot to the edge: where the pivot is hardly known, the fit would then find it where the
// knots chosen for a wrong pivot suit the edge best, and be sure of it.

// From the upper blade's frame into the spline's: b = growth R(turn) q + shift. The growth follows
// the first photograph's error of scale.
struct BladeMotion {
  double turn = 0, growth = 1;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
};

// From the present pose of the first photograph; `held` is the pose that it had at the start.
[[nodiscard]] BladeMotion MotionFrom(const Pose& held, const double* first_pose);

// Parameters of a pose on which the place of one edge depends: pivot x, y, angle of its blade,
// scale, offset.
inline constexpr int kEdgeSize = 5;
using EdgePose = Eigen::Matrix<double, kEdgeSize, 1>;

// Where an edge lies for the spline: a pose that takes its points into the spline's frame.
// Jacobians by the first photograph's pivot x, y, upper angle and scale, and by the edge's own
// pose.
struct EdgePlacement {
  EdgePose pose;
  Eigen::Matrix<double, kEdgeSize, 4> by_first;
  Eigen::Matrix<double, kEdgeSize, kEdgeSize> by_own;
};
[[nodiscard]] EdgePlacement PlaceEdge(const Pose& held,
                                      const double* first_pose,
                                      const double* own_pose,
                                      bool is_upper);

// A point of the upper blade, taken into the spline's frame. Jacobians by the point and by the
// first photograph's pivot x, y, upper angle and scale.
struct PlacedPoint {
  Eigen::Vector2d point;
  Eigen::Matrix2d by_point;
  Eigen::Matrix<double, 2, 4> by_first;
};
[[nodiscard]] PlacedPoint PlacePoint(const Pose& held,
                                     const double* first_pose,
                                     const Eigen::Vector2d& in_blade);

// The same curve in the blade's frame, over the same knots; exact but for what a turn of a spline
// is no spline any more.
[[nodiscard]] Eigen::VectorXd InBladeFrame(const SplineSpace& space,
                                           const Eigen::VectorXd& coefficients,
                                           const BladeMotion& motion);

// How the coefficients in the blade's frame follow the first photograph's pivot x, y, upper angle
// and scale while the curve stays in the photograph; for a spline's frame that is the blade's.
[[nodiscard]] Eigen::MatrixXd FrameJacobian(const SplineSpace& space,
                                            const Eigen::VectorXd& coefficients,
                                            const Pose& first_pose);

}  // namespace bladecurve
