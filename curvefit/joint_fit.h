// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "curvefit/bspline.h"
#include "curvefit/fit.h"
#include "curvefit/fit_data.h"
#include "curvefit/linear_spline.h"
#include "curvefit/minimize.h"
#include "curvefit/residuals.h"

namespace bladecurve {

// Which family, and what of the data is used.
struct JointModel {
  std::optional<SplineSpace> space;  // of the rigid spline; not set: the tapered form
  bool free_gain = false;            // of the tapered form
  Loss loss = Loss::kNone;           // of the spline's edges
  std::vector<bool> mirror;          // a photograph's lower edge is taken for a mirror image
};

// All parameters of a fit: the shape of either family, and what both share.
struct JointState {
  std::vector<double> shape;  // free coefficients of the spline, or a and b
  double gain = 0.5;          // of the tapered form
  // Pivot to upper distal end, and the opening that a given theta has where ours is 0. A rigid turn
  // has one of each for all photographs. In the tapered form the ends do not turn as theta says:
  // each photograph has its own.
  std::vector<double> reaches, zeros;
  std::vector<Pose> poses;
};

struct JointResult {
  JointState state;
  MinimizerReport minimizer;
};

// Minimises over all photographs together, from `start`.
[[nodiscard]] JointResult SolveJointly(const FitData& data,
                                       const JointModel& model,
                                       JointState start);

// Columns: shape, gain if free, reaches, zeros of given thetas, poses.
struct JointEstimate {
  Estimate estimate;
  Eigen::Index shape_columns = 0;  // shape and gain
  size_t num_reaches = 1;
  Eigen::Index first_pose = 0;
};
[[nodiscard]] JointEstimate EstimateJointly(const FitData& data,
                                            const JointModel& model,
                                            JointState state);

// Poses and reach as the observed ends have them; no shape yet.
[[nodiscard]] JointState StartingState(const FitData& data);

// The same, with a spline that was fitted to the edges at these poses.
[[nodiscard]] JointState SplineStart(const FitData& data, const LinearSpline& spline);

// Signed orthogonal distances of one edge from the curve, offset taken off, without a unit.
[[nodiscard]] std::vector<double> Distances(const EdgeSamples& edge,
                                            bool is_upper,
                                            const JointModel& model,
                                            const JointState& state,
                                            const Pose& pose);

// Sum of squares of the whitened distances.
[[nodiscard]] double Chi2(const EdgeSamples& edge, const std::vector<double>& distances);

// Sum of squares of the pose observations: pivots, ends, thetas, scales, offsets.
[[nodiscard]] double PoseChi2(const FitData& data,
                              const JointModel& model,
                              const JointState& state);

[[nodiscard]] RigidSpline SplineInMm(const SplineSpace& space,
                                     const Eigen::VectorXd& coefficients,
                                     double length_mm);

// The spline of a solved state. Throws Refused{kFitFailed} if it has left the blade far behind.
[[nodiscard]] BladeCurve CurveOf(const SplineSpace& space,
                                 const JointState& state,
                                 double length_mm,
                                 const CurveDomain& domain);

// The poses as the caller's frames have them, sigmas from the covariance.
[[nodiscard]] std::vector<FittedPose> PosesInMm(const FitData& data,
                                                const JointState& state,
                                                const JointEstimate& estimate);

}  // namespace bladecurve
