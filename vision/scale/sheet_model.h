// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "vision/scale/sheet_pose.h"

// How the sheet's squares are imaged, by the unknowns that SolveSheet solves for.
namespace bladecurve::sheet {

using Corners = std::array<Eigen::Vector2d, 4>;

// Unknowns: the camera's, the pose's, the spread, then x, y and angle of each square that lies
// anywhere but the first, which carries the sheet frame.
enum Unknown : int { kLogFocal, kK1, kTurn, kPlace = 5, kSpread = 8, kSquares };

// What the unknowns are measured from. Turns are kept small, relative to a base pose.
struct Base {
  const SheetProblem& problem;
  Eigen::Matrix3d rotation;
};

[[nodiscard]] Corners SquareCorners(double side_mm);
[[nodiscard]] Eigen::Vector2d Centre(const Corners& corners);
[[nodiscard]] Eigen::Matrix3d Rotation(const Eigen::Vector3d& turn);
[[nodiscard]] bool LiesAnywhere(const SheetProblem& problem);
[[nodiscard]] SheetPose PoseOf(const Base& base, const Eigen::VectorXd& x);

// Standard deviations of what is known beforehand; NaN where nothing is.
[[nodiscard]] Eigen::VectorXd PriorSigmas(const SheetProblem& problem, int unknowns);

// The unknowns that are not known exactly.
[[nodiscard]] std::vector<int> FreeUnknowns(const SheetProblem& problem, int unknowns);

// Whitened residuals: eight a square, then the deviations from what is known beforehand.
[[nodiscard]] Eigen::VectorXd Residuals(const Base& base, const Eigen::VectorXd& x);

// Derivatives of the residuals, a column for each free unknown, by central differences.
[[nodiscard]] Eigen::MatrixXd Jacobian(const Base& base,
                                       const Eigen::VectorXd& x,
                                       const std::vector<int>& free);

}  // namespace bladecurve::sheet
