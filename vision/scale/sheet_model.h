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
// anywhere but the first, which carries the sheet frame. A longer lens sees nearly the same of a
// sheet that is as much further away and as much more tilted, and bends the picture as much with
// k1 larger by the square: these count in units of the focal length's factor, and its square, which
// makes all unknowns nearly independent of each other.
enum Unknown : int { kLogFocal, kK1, kTilt, kTurn = 4, kPlace, kSpread = 8, kSquares };

[[nodiscard]] Corners SquareCorners(double side_mm);
[[nodiscard]] Eigen::Vector2d Centre(const Corners& corners);
[[nodiscard]] bool LiesAnywhere(const SheetProblem& problem);
[[nodiscard]] SheetPose PoseOf(const SheetProblem& problem, const Eigen::VectorXd& x);

// Sets the unknowns of the pose, the focal length's being set already. rotation: camera from sheet,
// which must not be seen from behind.
void SetPose(const Eigen::Matrix3d& rotation,
             const Eigen::Vector3d& sheet_in_camera_mm,
             Eigen::VectorXd* x);

// Standard deviations of what is known beforehand; NaN where nothing is.
[[nodiscard]] Eigen::VectorXd PriorSigmas(const SheetProblem& problem, int unknowns);

// The unknowns that are not known exactly.
[[nodiscard]] std::vector<int> FreeUnknowns(const SheetProblem& problem, int unknowns);

// Whitened residuals: eight a square, then the deviations from what is known beforehand.
[[nodiscard]] Eigen::VectorXd Residuals(const SheetProblem& problem, const Eigen::VectorXd& x);

// Derivatives of the residuals, a column for each free unknown, by central differences.
[[nodiscard]] Eigen::MatrixXd Jacobian(const SheetProblem& problem,
                                       const Eigen::VectorXd& x,
                                       const std::vector<int>& free);

}  // namespace bladecurve::sheet
