// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "curvefit/fit_data.h"

namespace bladecurve {

// What was done to one edge before the fit.
struct CleanReport {
  struct Rejected {
    int index = 0;      // of the point in its EdgePoints
    double sigmas = 0;  // how far it lies off, in its own sigma
  };
  std::vector<Rejected> rejected;
  double sigma_scale =
      1;  // all sigmas of the edge were multiplied by this: they were too small for its scatter
  double correlation_points = 1;  // neighbouring points that count as one
};

// Takes glints, nicks and dirt out of an edge and makes its sigmas honest. The edge is held against
// a flexible spline of its own, so neither its shape nor its pose is prejudged; up to 60 % of
// strewn outliers do no harm. With `reject` false only the sigmas are looked at.
CleanReport CleanEdge(EdgeSamples& edge, const Pose& pose, bool is_upper, bool reject);

}  // namespace bladecurve
