// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "curvefit/fit_report.h"
#include "curvefit/joint_fit.h"

namespace bladecurve {

// Of the upper edges, photograph by photograph, in order along the blade; no unit of length.
struct EdgeResiduals {
  std::vector<std::vector<double>> distances;
  double chi2 = 0;
  double effective = 0;  // independent samples
};
[[nodiscard]] EdgeResiduals UpperResiduals(const FitData& data,
                                           const JointModel& model,
                                           const JointState& state);

// Stretches of one sign, and how many there would be in noise.
struct RunCount {
  int runs = 0;
  double expected = 0, variance = 0;
};
[[nodiscard]] RunCount CountRuns(const EdgeResiduals& residuals);

// Runs, autocorrelation; chi2_per_freedom is left to the caller.
[[nodiscard]] ResidualTests TestResiduals(const EdgeResiduals& residuals);

// Leverage and Cook's distance of the upper edges' points, poses held.
[[nodiscard]] Influence InfluenceOf(const FitData& data,
                                    const JointModel& model,
                                    const JointState& state,
                                    const EdgeResiduals& residuals);

// The direction with the names of its largest parts.
[[nodiscard]] UndeterminedDirection Describe(const Eigen::VectorXd& direction,
                                             const std::vector<std::string>& names);

}  // namespace bladecurve
