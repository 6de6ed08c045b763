// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/blade_curve.h"
#include "vision/edge_points.h"

namespace bladecurve {

enum class Family { kAuto, kTaperedRectangle, kRigidSpline };

struct FitOptions {
  Family family = Family::kAuto;
  std::optional<double> gain = 0.5;    // of the tapered form; nullopt: free (needs photographs at two angles)
  std::optional<int> degree;           // of the spline; nullopt: the lowest that the edge needs
  std::optional<int> num_spans;        // polynomial pieces of the spline; nullopt: chosen by the criterion
  std::string loss = "huber";          // "none", "huber", "cauchy", "tukey"; scale tied to sigma
  int num_threads = 1;
};

// What the solver did, for one family. Reals that were never set are NaN.
struct FamilyFit {
  BladeCurve curve;
  std::vector<std::string> parameter_names;    // "a_mm", "b", "gain" or "c0_mm", "c1_mm", ...
  Eigen::MatrixXd covariance;                  // of them, in that order
  double rms_mm = std::numeric_limits<double>::quiet_NaN();
  int points = 0, inliers = 0;
  double effective_points = 0;                 // neighbours are correlated
  double condition_number = std::numeric_limits<double>::quiet_NaN();
  int rank = 0;
  int iterations = 0;
  bool converged = false;
  std::string termination;                     // the reason for stopping, in words
  double aicc = std::numeric_limits<double>::quiet_NaN();
};

// Where one photograph's scissors lie, refined by the fit: a rigid motion of the frame of its EdgePoints.
struct FittedPose {
  Eigen::Vector2d pivot_mm = Eigen::Vector2d::Zero();
  double axis_rad = 0;                         // of +x, in the frame of the EdgePoints
  double theta_rad = 0;
  double pivot_sigma_mm = 0, axis_sigma_rad = 0, theta_sigma_rad = 0;
  double rms_mm = 0;
};

struct BladeFit {
  FamilyFit recommended;
  std::vector<FamilyFit> alternatives;
  std::vector<FittedPose> poses;               // one a photograph, of the recommended fit
  double largest_difference_mm = 0;            // between the families over the theta domain
  double largest_difference_torque = 0;        // the same of the cutting torque, relative
  std::string why_recommended;
  std::vector<std::string> warnings;           // stable codes: "photographs_disagree", "families_part", ...
};

// Fits one blade to all photographs together: shared shape; pivot, axis, theta of each. Orthogonal distances, whitened.
// Throws std::invalid_argument for impossible options, Refused{kFitFailed, kEdgeTooShort} if no curve can be had.
[[nodiscard]] BladeFit FitBlade(const std::vector<EdgePoints>& photos, const FitOptions& options = {});

}  // namespace bladecurve
