// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/sheet_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vision/scale/camera.h"

namespace bladecurve::sheet {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector2d Project(const SheetPose& pose, const Vector2d& sheet_mm) {
  const Vector3d point = pose.camera_from_sheet.leftCols<2>() * sheet_mm + pose.sheet_in_camera_mm;
  return Distorted(pose.camera, (pose.camera.k * point).hnormalized());
}

Corners CornersMm(const SheetProblem& problem, const VectorXd& x, size_t square) {
  const auto& known = problem.squares[square].corners_mm;
  Corners corners = known ? *known : SquareCorners(problem.side_mm);
  const Vector2d centre = Centre(corners);
  const double growth = 1 + 2 * x[kSpread] / problem.side_mm;
  for (Vector2d& corner : corners) corner = centre + growth * (corner - centre);
  if (known || square == 0) return corners;
  const Vector3d placed = x.segment<3>(kSquares + 3 * (static_cast<int>(square) - 1));
  const Eigen::Rotation2Dd turn(placed.z());
  for (Vector2d& corner : corners) corner = turn * corner + placed.head<2>();
  return corners;
}

// By an axis and an angle.
Matrix3d Turned(const Vector3d& by) {
  const double angle = by.norm();
  if (angle < 1e-12) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, by / angle).toRotationMatrix();
}

// Of a sheet that faces the camera: x to the right, y up, z towards the camera.
Matrix3d Facing() { return Vector3d(1, -1, -1).asDiagonal(); }

}  // namespace

Corners SquareCorners(double side_mm) {
  const double h = 0.5 * side_mm;
  return {Vector2d(-h, h), Vector2d(h, h), Vector2d(h, -h), Vector2d(-h, -h)};
}

Vector2d Centre(const Corners& c) { return 0.25 * (c[0] + c[1] + c[2] + c[3]); }

bool LiesAnywhere(const SheetProblem& problem) { return !problem.squares.front().corners_mm; }

SheetPose PoseOf(const SheetProblem& problem, const VectorXd& x) {
  const double longer = std::exp(x[kLogFocal]);
  SheetPose pose;
  pose.camera = problem.knowledge.camera;
  pose.camera.k(0, 0) *= longer;
  pose.camera.k(1, 1) *= longer;
  pose.camera.distortion[0] = longer * longer * (pose.camera.distortion[0] + x[kK1]);
  const Vector3d tilt(longer * x[kTilt], longer * x[kTilt + 1], 0);
  pose.camera_from_sheet = Turned(tilt) * Turned({0, 0, x[kTurn]}) * Facing();
  pose.sheet_in_camera_mm = x.segment<3>(kPlace);
  pose.sheet_in_camera_mm.z() *= longer;
  return pose;
}

void SetPose(const Matrix3d& rotation, const Vector3d& sheet_in_camera_mm, VectorXd* x) {
  const double longer = std::exp((*x)[kLogFocal]);
  const Vector3d facing = Facing().col(2), normal = rotation.col(2);
  const Vector3d axis = facing.cross(normal);
  const double sine = axis.norm();
  const Vector3d tilt = sine < 1e-12
                            ? Vector3d::Zero().eval()
                            : (axis * (std::atan2(sine, facing.dot(normal)) / sine)).eval();
  const Matrix3d turn = Turned(tilt).transpose() * rotation * Facing();
  x->segment<2>(kTilt) = tilt.head<2>() / longer;
  (*x)[kTurn] = std::atan2(turn(1, 0), turn(0, 0));
  x->segment<3>(kPlace) = sheet_in_camera_mm;
  (*x)[kPlace + 2] /= longer;
}

VectorXd PriorSigmas(const SheetProblem& problem, int unknowns) {
  VectorXd sigmas = VectorXd::Constant(unknowns, std::nan(""));
  sigmas[kLogFocal] = problem.knowledge.log_focal_sigma;
  sigmas[kK1] = problem.knowledge.k1_sigma;
  sigmas[kSpread] = LiesAnywhere(problem) ? 0 : problem.spread_sigma_mm;
  return sigmas;
}

VectorXd Residuals(const SheetProblem& problem, const VectorXd& x) {
  const SheetPose pose = PoseOf(problem, x);
  const std::vector<SquareObservation>& squares = problem.squares;
  const VectorXd sigmas = PriorSigmas(problem, static_cast<int>(x.size()));
  VectorXd residuals(static_cast<long>(8 * squares.size()) + kSquares);
  long row = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const Corners corners = CornersMm(problem, x, i);
    for (size_t k = 0; k < 4; ++k, row += 2) {
      residuals.segment<2>(row) =
          (Project(pose, corners[k]) - squares[i].corners_px[k]) / squares[i].sigma_px;
    }
  }
  for (int i = 0; i < kSquares; ++i, ++row) {
    const double off =
        i == kK1 ? pose.camera.distortion[0] - problem.knowledge.camera.distortion[0] : x[i];
    residuals[row] = sigmas[i] > 0 ? off / sigmas[i] : 0;
  }
  return residuals;
}

std::vector<int> FreeUnknowns(const SheetProblem& problem, int unknowns) {
  const VectorXd sigmas = PriorSigmas(problem, unknowns);
  std::vector<int> free;
  for (int i = 0; i < unknowns; ++i) {
    if (sigmas[i] != 0) free.push_back(i);
  }
  return free;
}

MatrixXd Jacobian(const SheetProblem& problem, const VectorXd& x, const std::vector<int>& free) {
  MatrixXd jacobian(static_cast<long>(8 * problem.squares.size()) + kSquares,
                    static_cast<long>(free.size()));
  for (size_t c = 0; c < free.size(); ++c) {
    const double step = 1e-6 * std::max(1.0, std::abs(x[free[c]]));
    VectorXd plus = x, minus = x;
    plus[free[c]] += step;
    minus[free[c]] -= step;
    jacobian.col(static_cast<long>(c)) =
        (Residuals(problem, plus) - Residuals(problem, minus)) / (2 * step);
  }
  return jacobian;
}

}  // namespace bladecurve::sheet
