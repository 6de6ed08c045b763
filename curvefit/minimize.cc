// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/minimize.h"

#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/SVD>

namespace bladecurve {
namespace {

// Singular values of the scaled Jacobian below this part of the largest are rounding.
constexpr double kRankTolerance = 1e-12;

ceres::Solver::Options SolverOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;  // squares no condition number
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  options.num_threads = 1;
  options.max_num_iterations = 60;
  options.function_tolerance =
      1e-10;  // the step after such a one moves the curve by 1e-5 sigma at most
  options.parameter_tolerance = 1e-13;
  options.gradient_tolerance = 1e-14;
  options.initial_trust_region_radius =
      1e12;  // Gauss-Newton steps: the start is near, the priors may be weak
  options.max_trust_region_radius = 1e20;
  return options;
}

std::string InWords(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return "converged: " + summary.message;
    case ceres::NO_CONVERGENCE:
      return "stopped at the limit of iterations: " + summary.message;
    case ceres::FAILURE:
      return "failed: " + summary.message;
    default:
      return summary.message;
  }
}

}  // namespace

MinimizerReport Minimize(ceres::Problem& problem) {
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(), &problem, &summary);
  MinimizerReport report;
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.iterations = static_cast<int>(summary.iterations.size());
  report.cost = summary.final_cost;
  report.termination = InWords(summary);
  for (const ceres::IterationSummary& step : summary.iterations) {
    report.trace.push_back({step.iteration, step.cost, step.gradient_max_norm, step.step_norm});
  }
  return report;
}

Eigen::MatrixXd JacobianBy(ceres::Problem& problem, const std::vector<double*>& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks;
  ceres::CRSMatrix sparse;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &sparse)) return {};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int k = sparse.rows[row]; k < sparse.rows[row + 1]; ++k) {
      dense(row, sparse.cols[k]) = sparse.values[k];
    }
  }
  return dense;
}

Estimate EstimateFrom(const Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd scale = jacobian.colwise().norm();
  for (double& s : scale) s = s > 0 ? s : 1;
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian * inverse.asDiagonal(), Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  Estimate estimate;
  Eigen::VectorXd reciprocal = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values(i) > kRankTolerance * values(0)) {
      ++estimate.rank;
      reciprocal(i) = 1 / values(i);
    } else {
      estimate.undetermined.emplace_back(svd.matrixV().col(i));
    }
  }
  estimate.condition_number = values(0) / values(values.size() - 1);
  const Eigen::MatrixXd half = inverse.asDiagonal() * svd.matrixV() * reciprocal.asDiagonal();
  estimate.covariance = half * half.transpose();
  return estimate;
}

}  // namespace bladecurve
