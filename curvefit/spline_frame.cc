// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/spline_frame.h"

#include <Eigen/Geometry>
#include <cmath>

#include "curvefit/spline_shape.h"

namespace bladecurve {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Matrix2d Turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

Vector2d PivotOf(const double* pose) { return {pose[kPivotX], pose[kPivotY]}; }

Vector2d QuarterTurned(const Vector2d& v) { return {-v.y(), v.x()}; }

struct PlaceOnCurve {
  double s = 0, slope = 0;
};

PlaceOnCurve EvalSpline(const SplineSpace& space, const Eigen::VectorXd& coefficients, double u) {
  const BasisRow row = EvalBasis(space, u);
  PlaceOnCurve place;
  for (int j = 0; j <= space.degree; ++j) {
    place.s += row.value[j] * coefficients(row.first + j);
    place.slope += row.slope[j] * coefficients(row.first + j);
  }
  return place;
}

// v in the blade's frame of the curve at the blade's u: Newton on the spline's own u.
double HeightInBlade(const SplineSpace& space,
                     const Eigen::VectorXd& coefficients,
                     const BladeMotion& motion,
                     double u) {
  const double c = std::cos(motion.turn), s = std::sin(motion.turn);
  double at = motion.growth * u + motion.shift.x();
  double height = 0;
  constexpr int kSteps = 8;  // quadratic convergence from a start that is off by the turn
  for (int step = 0; step < kSteps; ++step) {
    const PlaceOnCurve place = EvalSpline(space, coefficients, at);
    const Vector2d q = (Vector2d(at, place.s) - motion.shift) / motion.growth;
    height = c * q.y() - s * q.x();
    at -= motion.growth * (c * q.x() + s * q.y() - u) / (c + s * place.slope);
  }
  return height;
}

}  // namespace

BladeMotion MotionFrom(const Pose& held, const double* first_pose) {
  BladeMotion motion;
  motion.turn = first_pose[kUpperAngle] - held[kUpperAngle];
  motion.growth = (1 + held[kScale]) / (1 + first_pose[kScale]);
  motion.shift =
      Turn(-held[kUpperAngle]) * (motion.growth * PivotOf(first_pose) - PivotOf(held.data()));
  return motion;
}

EdgePlacement PlaceEdge(const Pose& held,
                        const double* first_pose,
                        const double* own_pose,
                        bool is_upper) {
  const double side = is_upper ? 1 : -1;
  const BladeMotion motion = MotionFrom(held, first_pose);
  const double growth = motion.growth, growth_by_scale = -growth / (1 + first_pose[kScale]);
  const double angle = own_pose[is_upper ? kUpperAngle : kLowerAngle] - side * motion.turn;
  const Matrix2d to_photo = Turn(angle) * Vector2d(1, side).asDiagonal();
  const Matrix2d back = to_photo * Turn(-held[kUpperAngle]);
  const Vector2d pivot = PivotOf(own_pose), first_pivot = PivotOf(first_pose);
  const Vector2d shift = to_photo * motion.shift;

  EdgePlacement place;
  place.pose << growth * pivot - shift, angle, growth * (1 + own_pose[kScale]) - 1,
      growth * own_pose[kOffset];
  place.by_own = growth * Eigen::Matrix<double, kEdgeSize, kEdgeSize>::Identity();
  place.by_own.col(2) << -QuarterTurned(shift), 1, 0, 0;
  place.by_first.setZero();
  place.by_first.topLeftCorner<2, 2>() = -growth * back;
  place.by_first.col(2) << side * QuarterTurned(shift), -side, 0, 0;
  place.by_first.col(3) << growth_by_scale * (pivot - back * first_pivot), 0,
      growth_by_scale * (1 + own_pose[kScale]), growth_by_scale * own_pose[kOffset];
  return place;
}

PlacedPoint PlacePoint(const Pose& held, const double* first_pose, const Vector2d& in_blade) {
  const BladeMotion motion = MotionFrom(held, first_pose);
  const Matrix2d back = Turn(-held[kUpperAngle]);
  PlacedPoint placed;
  placed.by_point = motion.growth * Turn(motion.turn);
  const Vector2d turned = placed.by_point * in_blade;
  placed.point = turned + motion.shift;
  placed.by_first << motion.growth * back, QuarterTurned(turned),
      -(turned + motion.growth * back * PivotOf(first_pose)) / (1 + first_pose[kScale]);
  return placed;
}

Eigen::VectorXd InBladeFrame(const SplineSpace& space,
                             const Eigen::VectorXd& coefficients,
                             const BladeMotion& motion) {
  Eigen::VectorXd heights(space.size());
  Eigen::Index i = 0;
  for (const double u : GrevilleAbscissae(space)) {
    heights(i++) = HeightInBlade(space, coefficients, motion, u);
  }
  return SplineThrough(space, heights);
}

Eigen::MatrixXd FrameJacobian(const SplineSpace& space,
                              const Eigen::VectorXd& coefficients,
                              const Pose& first_pose) {
  // To first order, with growth 1 + g: v(u) = s(u + g u + shift_u - turn s) - g s - shift_v - turn
  // u.
  Eigen::MatrixXd by_motion(space.size(), 4);  // shift u, v, turn, g
  Eigen::Index i = 0;
  for (const double u : GrevilleAbscissae(space)) {
    const PlaceOnCurve place = EvalSpline(space, coefficients, u);
    by_motion.row(i++) << place.slope, -1, -u - place.s * place.slope, u * place.slope - place.s;
  }
  const Matrix2d turn = Turn(-first_pose[kUpperAngle]);
  const double by_scale = -1 / (1 + first_pose[kScale]);
  Eigen::Matrix4d by_pose = Eigen::Matrix4d::Identity();
  by_pose.topLeftCorner<2, 2>() = turn;
  by_pose.col(3) << by_scale * turn * PivotOf(first_pose.data()), 0, by_scale;
  return SplineThrough(space, by_motion) * by_pose;
}

}  // namespace bladecurve
