// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/linear_spline.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace bladecurve {
namespace {

// How far the starting poses may be off, as a part of the blade's length (and in rad).
constexpr double kPoseSlack = 0.05;
// Keeps the equations solvable where a basis function meets no point; far below the rounding of the
// data.
constexpr double kRidge = 1e-13;
constexpr int kPoseColumns = 3;  // offset, turn, shift along u

constexpr int kWidth = kMaxSplineDegree + 1;

// The columns of one point: its basis functions from `first` on (0 beyond the degree), and the
// motion of its photograph.
struct SparseRow {
  int first = 0, pose = -1;  // pose: first of three columns; -1 for the first photograph
  Eigen::Matrix<double, kWidth, 1> basis;
  Eigen::Vector3d motion;
};

SparseRow RowOf(const FlatPoint& point, int first_pose, const BasisTable& table) {
  const BasisRow basis = table.At(point.u);
  SparseRow row;
  row.first = basis.first;
  row.basis = point.weight * Eigen::Map<const Eigen::Matrix<double, kWidth, 1>>(basis.value.data());
  if (point.photo > 0) {
    row.pose = first_pose + kPoseColumns * (point.photo - 1);
    row.motion = point.weight * Eigen::Vector3d(1, point.u, point.slope);
  }
  return row;
}

// Normal equations; the lower triangle of the matrix is what counts. kWidth columns of padding
// after the coefficients, so that every row's block lies inside.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  explicit NormalEquations(Eigen::Index size)
      : matrix(Eigen::MatrixXd::Zero(size, size)), right(Eigen::VectorXd::Zero(size)) {}

  void Add(const SparseRow& row, double value) {
    matrix.block<kWidth, kWidth>(row.first, row.first) += row.basis * row.basis.transpose();
    right.segment<kWidth>(row.first) += value * row.basis;
    if (row.pose < 0) return;
    matrix.block<3, kWidth>(row.pose, row.first) += row.motion * row.basis.transpose();
    matrix.block<3, 3>(row.pose, row.pose) += row.motion * row.motion.transpose();
    right.segment<3>(row.pose) += value * row.motion;
  }
};

void AddStiffness(double stiffness, int coefficients, Eigen::MatrixXd& normal) {
  const double weight = stiffness * normal.diagonal().head(coefficients).mean();
  for (int j = 0; j + 2 < coefficients; ++j) {
    const Eigen::Vector3d difference(1, -2, 1);
    normal.block<3, 3>(j, j) += weight * difference * difference.transpose();
  }
}

int LastPhoto(const std::vector<FlatPoint>& points) {
  int last = 0;
  for (const FlatPoint& point : points) last = std::max(last, point.photo);
  return last;
}

}  // namespace

LinearSpline FitLinearSpline(const std::vector<FlatPoint>& points,
                             const SplineSpace& space,
                             double stiffness) {
  const int first_pose = space.size() + kWidth;
  const int pose_columns = kPoseColumns * LastPhoto(points);
  NormalEquations equations(first_pose + pose_columns);
  std::vector<SparseRow> rows;
  rows.reserve(points.size());
  const BasisTable table(space);
  for (const FlatPoint& point : points) {
    rows.push_back(RowOf(point, first_pose, table));
    equations.Add(rows.back(), point.weight * point.v);
  }
  Eigen::MatrixXd& normal = equations.matrix;
  normal.diagonal().tail(pose_columns).array() += 1 / (kPoseSlack * kPoseSlack);
  if (stiffness > 0) AddStiffness(stiffness, space.size(), normal);
  normal.diagonal().array() += kRidge * normal.diagonal().maxCoeff();
  const Eigen::VectorXd solution = normal.ldlt().solve(equations.right);

  LinearSpline fit{space, solution.head(space.size()), {}, 0};
  fit.residuals.reserve(points.size());
  for (size_t k = 0; k < points.size(); ++k) {
    const SparseRow& row = rows[k];
    double residual =
        points[k].weight * points[k].v - row.basis.dot(solution.segment<kWidth>(row.first));
    if (row.pose >= 0) residual -= row.motion.dot(solution.segment<3>(row.pose));
    fit.residuals.push_back(residual);
    fit.chi2 += residual * residual;
  }
  return fit;
}

std::vector<double> QuantileKnots(const std::vector<FlatPoint>& points, int num_spans) {
  std::vector<double> knots;
  for (int k = 1; k < num_spans; ++k) {
    const size_t i = k * points.size() / num_spans;
    const double knot = i > 0 ? (points[i - 1].u + points[i].u) / 2 : points[i].u;
    const double previous = knots.empty() ? points.front().u : knots.back();
    if (knot > previous && knot < points.back().u) knots.push_back(knot);
  }
  return knots;
}

std::vector<FlatPoint> Flatten(const EdgeSamples& edge,
                               const Pose& pose,
                               bool is_upper,
                               int photo) {
  std::vector<FlatPoint> flat;
  flat.reserve(edge.points.size());
  const BladeFrame frame(pose, is_upper);
  for (int i = 0; i < edge.size(); ++i) {
    const Eigen::Vector2d in_blade = frame(edge.points[i]);
    flat.push_back({in_blade.x(), in_blade.y(), edge.weights[i], photo});
  }
  std::sort(
      flat.begin(), flat.end(), [](const FlatPoint& a, const FlatPoint& b) { return a.u < b.u; });
  return flat;
}

}  // namespace bladecurve
