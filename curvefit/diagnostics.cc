// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/diagnostics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "curvefit/span_sums.h"
#include "curvefit/span_table.h"
#include "curvefit/spline_shape.h"
#include "curvefit/statistics.h"

namespace bladecurve {
namespace {

// The upper edges' points as the shape's basis functions have them: those of the spline, or of a
// straight line.
class ShapePoints {
 public:
  ShapePoints(const JointModel& model, const JointState& state)
      : space_(model.space.value_or(ClampedSpace(1, 0, 1, {}))),
        spans_(SpansOf(space_)),
        pieces_(spans_.size()),
        straight_(!model.space) {
    if (straight_) return;
    const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
    pieces_ =
        PiecesOf(spans_, space_.degree, CoefficientsOf(space_, state.shape.data(), end).value);
  }
  [[nodiscard]] const SplineSpace& space() const { return space_; }
  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }

  // Calls work(index of the point, of the span, t, weight of the curve there).
  template <typename Work>
  void ForEach(const EdgeSamples& edge, Pose pose, const Work& work) const {
    if (straight_) pose[kUpperAngle] = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
    const BladeFrame frame(pose, true);
    size_t span = 0;
    for (int i = 0; i < edge.size(); ++i) {
      const double u = frame(edge.points[i]).x();
      span = FindSpan(spans_, u, span);
      const double t = (u - spans_[span].centre) * spans_[span].scale;
      const double slope = Horner<kMaxSplineDegree>(pieces_[span].slope, t);
      work(i, span, t, edge.weights[i] / std::sqrt(1 + slope * slope));
    }
  }

 private:
  SplineSpace space_;
  std::vector<Span> spans_;
  std::vector<Piece> pieces_;
  bool straight_;
};

// The leverage of a point of weight 1 in each span, as powers of t up to twice the degree.
template <int Degree>
std::vector<std::array<double, 2 * Degree + 1>> LeverageOf(const FitData& data,
                                                           const JointState& state,
                                                           const ShapePoints& points) {
  constexpr int kBasis = Degree + 1;
  const std::vector<Span>& spans = points.spans();
  std::vector<SpanSums<Degree, 0>> sums(spans.size());
  for (size_t p = 0; p < data.photos.size(); ++p) {
    points.ForEach(data.photos[p].upper, state.poses[p], [&](int, size_t span, double t, double w) {
      sums[span].Add(t, w, {});
    });
  }
  const int size = points.space().size();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  for (size_t i = 0; i < spans.size(); ++i) {
    const Eigen::MatrixXd basis = BasisOf(spans[i], Degree);
    const auto first = static_cast<Eigen::Index>(i);
    normal.block(first, first, kBasis, kBasis) += basis.transpose() * sums[i].AllProducts() * basis;
  }
  normal.diagonal().array() += 1e-13 * normal.diagonal().maxCoeff();  // spans without points
  const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  std::vector<std::array<double, 2 * Degree + 1>> leverage(spans.size());
  for (size_t i = 0; i < spans.size(); ++i) {
    const Eigen::MatrixXd basis = BasisOf(spans[i], Degree);
    const auto first = static_cast<Eigen::Index>(i);
    const Eigen::MatrixXd form =
        basis * inverse.block(first, first, kBasis, kBasis) * basis.transpose();
    leverage[i].fill(0);
    for (int a = 0; a <= Degree; ++a) {
      for (int b = 0; b <= Degree; ++b) leverage[i][a + b] += form(a, b);
    }
  }
  return leverage;
}

template <int Degree>
Influence LargestInfluence(const FitData& data,
                           const JointState& state,
                           const EdgeResiduals& residuals,
                           const ShapePoints& points) {
  const auto leverage_in = LeverageOf<Degree>(data, state, points);
  Influence influence{0, 0, 0, 0};
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const EdgeSamples& edge = data.photos[p].upper;
    points.ForEach(edge, state.poses[p], [&](int i, size_t span, double t, double w) {
      double leverage = 0;
      for (int m = 2 * Degree; m >= 0; --m) leverage = leverage * t + leverage_in[span][m];
      leverage *= w * w;
      const double r = edge.weights[i] * residuals.distances[p][static_cast<size_t>(i)];
      const double rest = std::max(1 - leverage, 1e-9);  // a point that alone holds a coefficient
      const double cook = r * r * leverage / (rest * rest * points.space().size());
      influence.largest_leverage = std::max(influence.largest_leverage, leverage);
      if (cook <= influence.largest_cook) return;
      influence.largest_cook = cook;
      influence.photo = static_cast<int>(p);
      influence.index = edge.indices[i];
    });
  }
  return influence;
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
  const ShapePoints points(model, state);
  return WithDegree(points.space().degree, [&](auto degree) {
    return LargestInfluence<degree()>(data, state, residuals, points);
  });
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
