// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/diagnostics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "curvefit/statistics.h"

namespace bladecurve {
namespace {

// Derivatives of a point's whitened distance by the shape: a few columns that are not 0.
struct ShapeRow {
  int first = 0;
  Eigen::VectorXd values;
};

class ShapeRows {
 public:
  ShapeRows(const JointModel& model, const JointState& state) : model_(model), state_(state) {
    if (!model.space) return;
    coefficients_ =
        CoefficientsOf(*model.space, state.shape.data(), state.reaches[0], state.zeros[0]).value;
  }
  [[nodiscard]] int columns() const { return model_.space ? model_.space->size() : 2; }
  [[nodiscard]] ShapeRow At(const EdgeSamples& edge, int i, const Pose& pose) const {
    const double w = edge.weights[i];
    if (!model_.space) {
      Pose axis = pose;
      axis[kUpperAngle] = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
      return {0, w * Eigen::Vector2d(1, ToBladeFrame(axis, edge.points[i], true).x())};
    }
    const SplineDistance d =
        DistanceFrom(*model_.space, coefficients_.data(), ToBladeFrame(pose, edge.points[i], true));
    const int size = model_.space->degree + 1;
    return {d.first, w * Eigen::Map<const Eigen::VectorXd>(d.d_c.data(), size)};
  }

 private:
  const JointModel& model_;
  const JointState& state_;
  Eigen::VectorXd coefficients_;
};

Eigen::MatrixXd InverseNormal(const FitData& data, const JointState& state, const ShapeRows& rows) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(rows.columns(), rows.columns());
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const EdgeSamples& edge = data.photos[p].upper;
    for (int i = 0; i < edge.size(); ++i) {
      const ShapeRow row = rows.At(edge, i, state.poses[p]);
      const Eigen::Index n = row.values.size();
      normal.block(row.first, row.first, n, n) += row.values * row.values.transpose();
    }
  }
  normal.diagonal().array() += 1e-13 * normal.diagonal().maxCoeff();  // spans without points
  return normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

// The photographs' series one after the other, correlations never across.
double LagOne(const EdgeResiduals& residuals) {
  double product = 0, square = 0;
  for (const std::vector<double>& d : residuals.distances) {
    for (size_t i = 0; i < d.size(); ++i) {
      square += d[i] * d[i];
      if (i > 0) product += d[i] * d[i - 1];
    }
  }
  return square > 0 ? product / square : kNotSet;
}

}  // namespace

EdgeResiduals UpperResiduals(const FitData& data,
                             const JointModel& model,
                             const JointState& state) {
  EdgeResiduals residuals;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const EdgeSamples& edge = data.photos[p].upper;
    residuals.distances.push_back(Distances(edge, true, model, state, state.poses[p]));
    residuals.chi2 += Chi2(edge, residuals.distances.back());
    residuals.effective += edge.effective();
  }
  return residuals;
}

RunCount CountRuns(const EdgeResiduals& residuals) {
  RunCount count;
  for (const std::vector<double>& d : residuals.distances) {
    const auto above =
        static_cast<double>(std::count_if(d.begin(), d.end(), [](double x) { return x >= 0; }));
    const auto n = static_cast<double>(d.size());
    const double pairs = 2 * above * (n - above);
    count.expected += 1 + pairs / n;
    if (n > 1) count.variance += pairs * (pairs - n) / (n * n * (n - 1));
    for (size_t i = 0; i < d.size(); ++i) {
      count.runs += i == 0 || (d[i] >= 0) != (d[i - 1] >= 0) ? 1 : 0;
    }
  }
  return count;
}

ResidualTests TestResiduals(const EdgeResiduals& residuals) {
  ResidualTests tests;
  const RunCount count = CountRuns(residuals);
  tests.runs = count.runs;
  if (count.variance > 0) tests.runs_z = (count.runs - count.expected) / std::sqrt(count.variance);
  tests.autocorrelation = LagOne(residuals);
  tests.correlation_points = 0;
  for (const std::vector<double>& d : residuals.distances) {
    tests.correlation_points = std::max(tests.correlation_points, CorrelatedNeighbours(d));
  }
  return tests;
}

Influence InfluenceOf(const FitData& data,
                      const JointModel& model,
                      const JointState& state,
                      const EdgeResiduals& residuals) {
  const ShapeRows rows(model, state);
  const Eigen::MatrixXd inverse = InverseNormal(data, state, rows);
  Influence influence{0, 0, 0, 0};
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const EdgeSamples& edge = data.photos[p].upper;
    for (int i = 0; i < edge.size(); ++i) {
      const ShapeRow row = rows.At(edge, i, state.poses[p]);
      const Eigen::Index n = row.values.size();
      const double leverage =
          row.values.dot(inverse.block(row.first, row.first, n, n) * row.values);
      const double r = edge.weights[i] * residuals.distances[p][i];
      const double rest = std::max(1 - leverage, 1e-9);  // a point that alone holds a coefficient
      const double cook = r * r * leverage / (rest * rest * rows.columns());
      influence.largest_leverage = std::max(influence.largest_leverage, leverage);
      if (cook <= influence.largest_cook) continue;
      influence.largest_cook = cook;
      influence.photo = static_cast<int>(p);
      influence.index = edge.indices[i];
    }
  }
  return influence;
}

UndeterminedDirection Describe(const Eigen::VectorXd& direction,
                               const std::vector<std::string>& names) {
  UndeterminedDirection out{{direction.data(), direction.data() + direction.size()}, {}};
  constexpr double kWorthNaming = 0.2;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction(i)) < kWorthNaming) continue;
    out.text += (out.text.empty() ? "" : " with ") + names[static_cast<size_t>(i)];
  }
  return out;
}

}  // namespace bladecurve
