// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "curvefit/fit_report.h"

namespace ceres {
class Problem;
}

namespace bladecurve {

struct MinimizerReport {
  bool converged = false;
  int iterations = 0;
  double cost = 0;          // half the sum of squares
  std::string termination;  // in words
  std::vector<IterationRecord> trace;
};

// Levenberg and Marquardt until nothing changes any more. One thread: the same bits whatever the
// machine.
[[nodiscard]] MinimizerReport Minimize(ceres::Problem& problem);

// The Jacobian by the given parameter blocks, in their order, at their present values.
[[nodiscard]] Eigen::MatrixXd JacobianBy(ceres::Problem& problem,
                                         const std::vector<double*>& blocks);

// (J^T J)^-1 over the directions that the observations determine.
struct Estimate {
  Eigen::MatrixXd covariance;  // nothing of the undetermined directions is in it
  int rank = 0;
  double condition_number = kNotSet;          // of the Jacobian with columns of unit length
  std::vector<Eigen::VectorXd> undetermined;  // unit vectors over scaled parameters
};
[[nodiscard]] Estimate EstimateFrom(const Eigen::MatrixXd& jacobian);

}  // namespace bladecurve
