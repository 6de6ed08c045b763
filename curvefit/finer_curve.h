// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "curvefit/fit_report.h"
#include "curvefit/joint_fit.h"

namespace bladecurve {

// The fitted spline over many more knots, and a covariance (mm^2) that also holds what the chosen
// degree and knots may have missed; `covariance` is that of its coefficients as if these were
// beyond doubt.
//
// Knots chosen from the same noise look better than they are, and slopes between them show it. So
// the edge is fitted once more without choosing: a knot every 24th of its length, the jumps of the
// highest derivative there a random walk's, of the size that the points make likeliest (a smoothing
// spline, whose Bayesian intervals hold along the curve on average: Wahba 1983, Nychka 1988). Its
// spread and its distance from the fitted spline make the band.
[[nodiscard]] FinerCurve RefineCurve(const FitData& data,
                                     const JointModel& model,
                                     const JointState& state,
                                     const Eigen::MatrixXd& covariance);

}  // namespace bladecurve
