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

Corners CornersMm(const Base& base, const VectorXd& x, size_t square) {
  const auto& known = base.problem.squares[square].corners_mm;
  Corners corners = known ? *known : SquareCorners(base.problem.side_mm);
  const Vector2d centre = Centre(corners);
  const double growth = 1 + 2 * x[kSpread] / base.problem.side_mm;
  for (Vector2d& corner : corners) corner = centre + growth * (corner - centre);
  if (known || square == 0) return corners;
  const Vector3d placed = x.segment<3>(kSquares + 3 * (static_cast<int>(square) - 1));
  const Eigen::Rotation2Dd turn(placed.z());
  for (Vector2d& corner : corners) corner = turn * corner + placed.head<2>();
  return corners;
}

}  // namespace

Corners SquareCorners(double side_mm) {
  const double h = 0.5 * side_mm;
  return {Vector2d(-h, h), Vector2d(h, h), Vector2d(h, -h), Vector2d(-h, -h)};
}

Vector2d Centre(const Corners& c) { return 0.25 * (c[0] + c[1] + c[2] + c[3]); }

Matrix3d Rotation(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

bool LiesAnywhere(const SheetProblem& problem) { return !problem.squares.front().corners_mm; }

SheetPose PoseOf(const Base& base, const VectorXd& x) {
  SheetPose pose;
  pose.camera = base.problem.knowledge.camera;
  pose.camera.k(0, 0) *= std::exp(x[kLogFocal]);
  pose.camera.k(1, 1) *= std::exp(x[kLogFocal]);
  pose.camera.distortion[0] += x[kK1];
  pose.camera_from_sheet = Rotation(x.segment<3>(kTurn)) * base.rotation;
  // A longer focal length sees the same from further away; measured so, the two are nearly
  // independent.
  pose.sheet_in_camera_mm = std::exp(x[kLogFocal]) * x.segment<3>(kPlace);
  return pose;
}

VectorXd PriorSigmas(const SheetProblem& problem, int unknowns) {
  VectorXd sigmas = VectorXd::Constant(unknowns, std::nan(""));
  sigmas[kLogFocal] = problem.knowledge.log_focal_sigma;
  sigmas[kK1] = problem.knowledge.k1_sigma;
  sigmas[kSpread] = LiesAnywhere(problem) ? 0 : problem.spread_sigma_mm;
  return sigmas;
}

VectorXd Residuals(const Base& base, const VectorXd& x) {
  const SheetPose pose = PoseOf(base, x);
  const std::vector<SquareObservation>& squares = base.problem.squares;
  const VectorXd sigmas = PriorSigmas(base.problem, static_cast<int>(x.size()));
  VectorXd residuals(static_cast<long>(8 * squares.size()) + kSquares);
  long row = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const Corners corners = CornersMm(base, x, i);
    for (size_t k = 0; k < 4; ++k, row += 2) {
      residuals.segment<2>(row) =
          (Project(pose, corners[k]) - squares[i].corners_px[k]) / squares[i].sigma_px;
    }
  }
  for (int i = 0; i < kSquares; ++i) residuals[row++] = sigmas[i] > 0 ? x[i] / sigmas[i] : 0;
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

MatrixXd Jacobian(const Base& base, const VectorXd& x, const std::vector<int>& free) {
  MatrixXd jacobian(static_cast<long>(8 * base.problem.squares.size()) + kSquares,
                    static_cast<long>(free.size()));
  for (size_t c = 0; c < free.size(); ++c) {
    const double step = 1e-6 * std::max(1.0, std::abs(x[free[c]]));
    VectorXd plus = x, minus = x;
    plus[free[c]] += step;
    minus[free[c]] -= step;
    jacobian.col(static_cast<long>(c)) =
        (Residuals(base, plus) - Residuals(base, minus)) / (2 * step);
  }
  return jacobian;
}

}  // namespace bladecurve::sheet
