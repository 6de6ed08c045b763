// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curvefit/bspline.h"
#include "curvefit/fit_data.h"

namespace bladecurve {

// A point of an edge in its blade's frame.
struct FlatPoint {
  double u = 0, v = 0;
  double weight = 0;  // 1/sigma
  int photo = 0;
  double slope = 0;  // of the edge there, as far as known: how a shift along u shows
};

// A spline with the poses held: linear, so that many knot vectors can be tried cheaply.
struct LinearSpline {
  SplineSpace space;
  Eigen::VectorXd coefficients;
  std::vector<double> residuals;  // whitened, v - s(u)
  double chi2 = 0;
  // Of each photograph's edge against the first one's: offset along v, turn, shift along u.
  std::vector<Eigen::Vector3d> motions;
};

// Least squares. The edges of photographs beyond the first may shift and turn a little against the
// first one: their poses are known only roughly. `stiffness` > 0 penalises second differences of
// the coefficients, relative to the weight of the data: it carries the spline over stretches
// without points.
[[nodiscard]] LinearSpline FitLinearSpline(const std::vector<FlatPoint>& points,
                                           const SplineSpace& space,
                                           double stiffness = 0);

// By u.
void SortAlong(std::vector<FlatPoint>& points);

// Interior knots such that every span holds the same number of points, which must be sorted by u.
[[nodiscard]] std::vector<double> QuantileKnots(const std::vector<FlatPoint>& points,
                                                int num_spans);

// The upper edges of all photographs, or one edge, in the blade's frame at the starting poses;
// sorted by u.
[[nodiscard]] std::vector<FlatPoint> Flatten(const EdgeSamples& edge,
                                             const Pose& pose,
                                             bool is_upper,
                                             int photo = 0);

}  // namespace bladecurve
