// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/diagnostics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "curvefit/span_table.h"
#include "curvefit/spline_shape.h"
#include "curvefit/statistics.h"

namespace bladecurve {
namespace {

constexpr int kRowSize = kMaxSplineDegree + 1;
using RowValues = Eigen::Matrix<double, kRowSize, 1>;
using RowMatrix = Eigen::Matrix<double, kRowSize, kRowSize>;

// Derivatives of a point's whitened distance by the shape: the columns from `first` on that are not
// 0.
struct ShapeRow {
  int first = 0;
  RowValues values = RowValues::Zero();
};

class ShapeRows {
 public:
  ShapeRows(const JointModel& model, const JointState& state) : is_spline_(model.space) {
    if (!is_spline_) return;
    const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
    degree_ = model.space->degree;
    columns_ = model.space->size();
    spans_ = SpansOf(*model.space);
    pieces_ =
        PiecesOf(spans_, degree_, CoefficientsOf(*model.space, state.shape.data(), end).value);
  }
  [[nodiscard]] int columns() const { return columns_; }

  // The rows of one edge; two for a straight line: 1 and x.
  [[nodiscard]] std::vector<ShapeRow> Of(const EdgeSamples& edge, Pose pose) const {
    if (!is_spline_) pose[kUpperAngle] = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
    const BladeFrame frame(pose, true);
    std::vector<ShapeRow> rows(edge.points.size());
    size_t span = 0;
    for (int i = 0; i < edge.size(); ++i) {
      const Eigen::Vector2d p = frame(edge.points[i]);
      ShapeRow& row = rows[static_cast<size_t>(i)];
      if (is_spline_) {
        span = FindSpan(spans_, p.x(), span);
        const double t = (p.x() - spans_[span].centre) * spans_[span].scale;
        const double slope = Horner<kMaxSplineDegree>(pieces_[span].slope, t);
        row.first = static_cast<int>(span);
        for (int j = 0; j <= degree_; ++j) {
          row.values(j) = Horner<kMaxSplineDegree>(spans_[span].basis[j], t);
        }
        row.values /= std::sqrt(1 + slope * slope);
      } else {
        row.values.head<2>() << 1, p.x();
      }
      row.values *= edge.weights[i];
    }
    return rows;
  }

 private:
  bool is_spline_;
  int degree_ = 1, columns_ = 2;
  std::vector<Span> spans_;
  std::vector<Piece> pieces_;
};

// The inverse normal matrix, padded so that every row's block lies inside.
Eigen::MatrixXd InverseNormal(const std::vector<std::vector<ShapeRow>>& rows, int columns) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns + kRowSize, columns + kRowSize);
  for (const std::vector<ShapeRow>& edge : rows) {
    for (const ShapeRow& row : edge) {
      normal.block<kRowSize, kRowSize>(row.first, row.first) += row.values * row.values.transpose();
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
  const ShapeRows shape(model, state);
  std::vector<std::vector<ShapeRow>> rows;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    rows.push_back(shape.Of(data.photos[p].upper, state.poses[p]));
  }
  const Eigen::MatrixXd inverse = InverseNormal(rows, shape.columns());
  Influence influence{0, 0, 0, 0};
  for (size_t p = 0; p < rows.size(); ++p) {
    const EdgeSamples& edge = data.photos[p].upper;
    for (size_t i = 0; i < rows[p].size(); ++i) {
      const ShapeRow& row = rows[p][i];
      const RowMatrix block = inverse.block<kRowSize, kRowSize>(row.first, row.first);
      const double leverage = row.values.dot(block * row.values);
      const double r = edge.weights[i] * residuals.distances[p][i];
      const double rest = std::max(1 - leverage, 1e-9);  // a point that alone holds a coefficient
      const double cook = r * r * leverage / (rest * rest * shape.columns());
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
