// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "curvefit/fit_report.h"
#include "model/blade_curve.h"
#include "vision/edge_points.h"

namespace bladecurve {

enum class Family { kAuto, kTaperedRectangle, kRigidSpline };

struct FitOptions {
  Family family = Family::kAuto;
  std::optional<double> gain =
      0.5;  // of the tapered form; nullopt: free (needs photographs at two angles)
  std::optional<int> degree;  // of the spline; nullopt: the lowest that the edge needs
  std::optional<int>
      num_spans;  // polynomial pieces of the spline; nullopt: chosen by the criterion
  std::optional<std::vector<double>>
      knots_mm;                // interior knots, increasing; then num_spans is not asked
  std::string loss = "huber";  // "none", "huber", "cauchy", "tukey"; scale tied to sigma
  int num_threads = 1;         // kept for callers; the fit takes milliseconds on one
};

// Where one photograph's scissors lie, refined by the fit: a rigid motion of the frame of its
// EdgePoints.
struct FittedPose {
  Eigen::Vector2d pivot_mm = Eigen::Vector2d::Zero();
  double axis_rad = 0;  // of +x, in the frame of the EdgePoints
  double theta_rad = 0;
  double pivot_sigma_mm = 0, axis_sigma_rad = 0, theta_sigma_rad = 0;
  Eigen::Matrix2d pivot_covariance_mm2 = Eigen::Matrix2d::Zero();  // in the frame of the EdgePoints
  double scale_relative = 0;  // the photograph's lengths times 1 + this are mm
  double offset_mm = 0;       // of its edges along their normals, out of the blades
  double rms_mm = 0;          // of the upper edge
};

// What the solver did, for one family. Reals that were never set are NaN.
struct FamilyFit {
  BladeCurve curve{TaperedRectangle{}, {0, 1, 0, 1}};  // y = 0 until one is fitted
  std::vector<std::string>
      parameter_names;              // "a_mm", "b", "gain" (if free) or "c0_mm", "c1_mm", ...
  Eigen::MatrixXd covariance;       // of them, in that order; all systematic parts included
  std::optional<FinerCurve> finer;  // of a spline: the bands of the curve come from this
  std::vector<FittedPose> poses;    // one a photograph
  double rms_mm = kNotSet;          // orthogonal, of the upper edges' inliers
  int points = 0, inliers = 0;      // of the upper edges
  double effective_points = 0;      // neighbours are correlated
  double chi2 = kNotSet, freedom = kNotSet;  // of edges and pose observations together
  double pose_chi2 = kNotSet;                // of the pose observations alone
  double disagreement = 0;                   // of several photographs: rms, in sigmas of a point
  double sigma_scale = 1;  // > 1: the family misses the edge, and sigma was widened by this
  double condition_number = kNotSet;
  int rank = 0, num_parameters = 0;  // shape and poses
  std::vector<UndeterminedDirection> undetermined;
  std::vector<std::string> limits;  // what kept the fit from being better: active limits, in words
  int iterations = 0;
  bool converged = false;
  std::string termination;  // the reason for stopping, in words
  std::vector<IterationRecord> trace;
  double bic = kNotSet, aicc = kNotSet;  // with the effective number of points
  ResidualTests residual_tests;
  Influence influence;
};

struct BladeFit {
  FamilyFit recommended;
  std::vector<FamilyFit> alternatives;
  std::vector<FittedPose> poses;         // of the recommended fit
  double largest_difference_mm = 0;      // between the families over the theta domain
  double largest_difference_torque = 0;  // the same of the cutting torque, relative
  FamilyDifference difference;           // where that is
  GainFinding gain;                      // what the photographs say about the tapered form's gain
  std::string why_recommended;
  std::string theta_definition;  // "distal-ends", or "given" by the user
  std::vector<KnotCandidate> knots_tried;
  std::vector<RejectedPoint> rejected;
  std::vector<EdgeFinding> edges;
  // Stable codes. Warnings are doubts about this result: "photographs_disagree", "families_part"
  // (the families differ at the photographed angles, and these do not decide between them), ...
  // Notes are not: "families_part" (only at other angles, where a family is an assumption).
  std::vector<std::string> warnings, notes;
};

// Fits one blade to all photographs together: shared shape; pivot, axis, theta of each. Orthogonal
// distances, whitened. The scale errors and the common offsets of different photographs are taken
// as independent. Domain of the curve: x from the first free edge point to the last one's reach at
// the smallest theta; theta from 0 to 60 deg, or a quarter beyond the largest photographed angle.
// Throws std::invalid_argument for impossible options, Refused{kFitFailed, kEdgeTooShort} if no
// curve can be had or theta stays open.
[[nodiscard]] BladeFit FitBlade(const std::vector<EdgePoints>& photos,
                                const FitOptions& options = {});

}  // namespace bladecurve
