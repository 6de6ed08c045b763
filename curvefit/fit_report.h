// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "model/blade_curve.h"

namespace bladecurve {

inline constexpr double kNotSet = std::numeric_limits<double>::quiet_NaN();

// One step of the minimiser.
struct IterationRecord {
  int iteration = 0;
  double cost = 0, gradient_max = 0, step_norm = 0;
};

// One number of degree and knots that was tried, poses held.
struct KnotCandidate {
  int degree = 0, spans = 0;
  double chi2 = 0;
  double bic = 0;  // chi2 + coefficients * ln(effective points)
};

// A point that the fit does not believe.
struct RejectedPoint {
  int photo = 0;
  bool is_upper = true;
  int index = 0;      // in EdgePoints::upper or lower
  double sigmas = 0;  // distance from its edge, in sigma
};

// Are the residuals of the upper edges noise? Along each edge, all photographs together.
struct ResidualTests {
  int runs = 0;                         // stretches of one sign
  double runs_z = kNotSet;              // of the Wald-Wolfowitz test: beyond +-3 is no noise
  double autocorrelation = kNotSet;     // of next neighbours
  double correlation_points = kNotSet;  // neighbours that vary as one
  double chi2_per_freedom = kNotSet;
};

// The point that moves the curve most.
struct Influence {
  double largest_leverage = kNotSet;  // 0 to 1: the part of its own position in the curve there
  double largest_cook = kNotSet;      // Cook's distance; 1 and more moves the curve by its sigma
  int photo = 0, index = 0;           // of that point, in EdgePoints::upper
};

// A combination of parameters that the photographs leave open; unit vector over scaled parameters.
struct UndeterminedDirection {
  std::vector<double> direction;
  std::string text;  // the parameters with the largest share
};

// The fitted spline written over finer knots, for its bands: what the chosen degree and knots may
// have missed has room there.
struct FinerCurve {
  RigidSpline curve;
  Eigen::MatrixXd covariance;         // of its coefficients, mm^2
  double effective_coefficients = 0;  // that the points determine, knots left open
};

// How the sigmas of one edge had to be widened before they agreed with its scatter.
struct EdgeFinding {
  int photo = 0;
  bool is_upper = true;
  double sigma_scale = 1;         // > 1: the scatter is larger than stated
  double correlation_points = 1;  // neighbours that count as one
  int points = 0, rejected = 0;
  bool used = true;  // a lower edge that is no mirror image is left out
};

// What the photographs say about the gain of the tapered form when it is left free.
struct GainFinding {
  double gain = kNotSet, sigma = kNotSet;  // NaN: photographs at one angle only
  double chi2_per_freedom = kNotSet;
};

// Where the two families differ most, over the theta domain.
struct FamilyDifference {
  double largest_mm = 0, at_x_mm = 0, at_theta_rad = 0;
  double largest_torque = 0,
         torque_at_theta_rad = 0;  // |tau_a / tau_b - 1| of sharp cutting where phi = 0
  // At the smallest angle from 5 deg on at which both edges cross the axis.
  double near_closing_mm = 0;
  double near_closing_torque = 0, near_closing_theta_rad = 0;
  // The largest at the photographs' angles; torque NaN where an edge crosses the axis at none of
  // them.
  double photographed_mm = 0, photographed_torque = kNotSet;
};

}  // namespace bladecurve
