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

// The columns of one point: its basis functions, then the motion of its photograph.
struct SparseRow {
  std::array<int, kMaxSplineDegree + 1 + kPoseColumns> columns;
  std::array<double, kMaxSplineDegree + 1 + kPoseColumns> values;
  int size = 0;

  void Add(int column, double value) {
    columns[size] = column;
    values[size++] = value;
  }
};

SparseRow RowOf(const FlatPoint& point, const SplineSpace& space, const BasisTable& table) {
  SparseRow row;
  const BasisRow basis = table.At(point.u);
  for (int j = 0; j <= space.degree; ++j) {
    row.Add(basis.first + j, point.weight * basis.value[j]);
  }
  if (point.photo > 0) {
    const int first = space.size() + kPoseColumns * (point.photo - 1);
    row.Add(first, point.weight);
    row.Add(first + 1, point.weight * point.u);
    row.Add(first + 2, point.weight * point.slope);
  }
  return row;
}

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
  const int columns = space.size() + kPoseColumns * LastPhoto(points);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns);
  std::vector<SparseRow> rows;
  const BasisTable table(space);
  rows.reserve(points.size());
  for (const FlatPoint& point : points) {
    rows.push_back(RowOf(point, space, table));
    const SparseRow& row = rows.back();
    for (int i = 0; i < row.size; ++i) {
      right(row.columns[i]) += row.values[i] * point.weight * point.v;
      for (int j = 0; j < row.size; ++j) {
        normal(row.columns[i], row.columns[j]) += row.values[i] * row.values[j];
      }
    }
  }
  normal.diagonal().tail(columns - space.size()).array() += 1 / (kPoseSlack * kPoseSlack);
  if (stiffness > 0) AddStiffness(stiffness, space.size(), normal);
  normal.diagonal().array() += kRidge * normal.diagonal().maxCoeff();
  const Eigen::VectorXd solution = normal.ldlt().solve(right);

  LinearSpline fit{space, solution.head(space.size()), {}, 0};
  fit.residuals.reserve(points.size());
  for (size_t k = 0; k < points.size(); ++k) {
    double residual = points[k].weight * points[k].v;
    for (int i = 0; i < rows[k].size; ++i) {
      residual -= rows[k].values[i] * solution(rows[k].columns[i]);
    }
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
