// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/linear_spline.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "curvefit/span_sums.h"
#include "curvefit/span_table.h"

namespace bladecurve {
namespace {

// How far the starting poses may be off, as a part of the blade's length (and in rad).
constexpr double kPoseSlack = 0.05;
// Keeps the equations solvable where a basis function meets no point; far below the rounding of the
// data.
constexpr double kLeastRidge = 1e-13;
// A photograph beyond the first may be off by an offset, a turn and a shift along u.
constexpr int kMotions = 3;
// Beside the powers of t: v, and the edge's slope, with which a shift along u shows. One photograph
// alone needs no slope.
constexpr int kValue = 0, kSlope = 1;

// First of the columns that move a photograph beyond the first.
int MotionColumn(const SplineSpace& space, int photo) {
  return space.size() + kMotions * (photo - 1);
}

struct LinearEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  explicit LinearEquations(Eigen::Index size)
      : matrix(Eigen::MatrixXd::Zero(size, size)), right(Eigen::VectorXd::Zero(size)) {}

  // The points of the first photograph in one span, as basis functions and v.
  void AddFirst(const Eigen::MatrixXd& basis, int first, const Eigen::MatrixXd& products) {
    const Eigen::Index size = basis.cols();
    matrix.block(first, first, size, size) +=
        basis.transpose() * products.topLeftCorner(size, size) * basis;
    right.segment(first, size) += basis.transpose() * products.col(size + kValue).head(size);
  }

  // Those of another one: its motions as well, in the columns from `motion` on.
  void AddMoving(const Eigen::MatrixXd& basis,
                 const Span& span,
                 int first,
                 int motion,
                 const Eigen::MatrixXd& products) {
    AddFirst(basis, first, products);
    const Eigen::Index size = basis.cols();
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(size + 2, kMotions);
    motions(0, 0) = 1;
    motions(0, 1) = span.centre;  // u = centre + t/scale
    motions(1, 1) = 1 / span.scale;
    motions(size + kSlope, 2) = 1;
    const Eigen::MatrixXd by_motions = motions.transpose() * products;
    matrix.block(motion, first, kMotions, size) += by_motions.leftCols(size) * basis;
    matrix.block<kMotions, kMotions>(motion, motion) += by_motions * motions;
    right.segment<kMotions>(motion) += by_motions.col(size + kValue);
  }
};

// Calls flush(span) when the points of a span are over, add(point, t) for each point.
template <typename Add, typename Flush>
void SpanBySpan(const std::vector<FlatPoint>& points,
                const std::vector<Span>& spans,
                const Add& add,
                const Flush& flush) {
  size_t span = 0;
  for (const FlatPoint& point : points) {
    const size_t here = FindSpan(spans, point.u, span);
    if (here != span) {
      flush(span);
      span = here;
    }
    add(point, (point.u - spans[span].centre) * spans[span].scale);
  }
  flush(span);
}

// The lower triangle of the matrix is what counts.
template <int Degree>
void AddOnePhoto(const std::vector<FlatPoint>& points,
                 const std::vector<Span>& spans,
                 LinearEquations& equations) {
  SpanSums<Degree, 1> sums;
  const auto add = [&](const FlatPoint& point, double t) {
    sums.Add(t, point.weight, {point.weight * point.v});
  };
  const auto flush = [&](size_t span) {
    equations.AddFirst(BasisOf(spans[span], Degree), static_cast<int>(span), sums.AllProducts());
    sums = {};
  };
  SpanBySpan(points, spans, add, flush);
}

template <int Degree>
void AddPhotos(const std::vector<FlatPoint>& points,
               const SplineSpace& space,
               const std::vector<Span>& spans,
               int photos,
               LinearEquations& equations) {
  std::vector<SpanSums<Degree, 2>> sums(photos);
  const auto add = [&](const FlatPoint& point, double t) {
    sums[point.photo].Add(t, point.weight, {point.weight * point.v, point.weight * point.slope});
  };
  const auto flush = [&](size_t span) {
    const int first = static_cast<int>(span);
    const Eigen::MatrixXd basis = BasisOf(spans[span], Degree);
    equations.AddFirst(basis, first, sums[0].AllProducts());
    for (int photo = 1; photo < photos; ++photo) {
      equations.AddMoving(
          basis, spans[span], first, MotionColumn(space, photo), sums[photo].AllProducts());
    }
    for (auto& sum : sums) sum = {};
  };
  SpanBySpan(points, spans, add, flush);
}

template <int Degree>
void FillResiduals(const std::vector<FlatPoint>& points,
                   const std::vector<Span>& spans,
                   LinearSpline& fit) {
  const std::vector<Piece> pieces = PiecesOf(spans, Degree, fit.coefficients);
  fit.residuals.resize(points.size());
  size_t span = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const FlatPoint& point = points[i];
    span = FindSpan(spans, point.u, span);
    const double t = (point.u - spans[span].centre) * spans[span].scale;
    const Eigen::Vector3d& motion = fit.motions[point.photo];
    const double moved = motion(0) + point.u * motion(1) + point.slope * motion(2);
    fit.residuals[i] = point.weight * (point.v - moved - Horner<Degree>(pieces[span].value, t));
    fit.chi2 += fit.residuals[i] * fit.residuals[i];
  }
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
  const int last_photo = LastPhoto(points), motions = kMotions * last_photo;
  const std::vector<Span> spans = SpansOf(space);
  LinearEquations equations(space.size() + motions);
  WithDegree(space.degree, [&](auto degree) {
    if (last_photo == 0) return AddOnePhoto<degree()>(points, spans, equations);
    AddPhotos<degree()>(points, space, spans, last_photo + 1, equations);
  });
  Eigen::MatrixXd& normal = equations.matrix;
  normal.diagonal().tail(motions).array() += 1 / (kPoseSlack * kPoseSlack);
  if (stiffness > 0) AddStiffness(stiffness, space.size(), normal);
  normal.diagonal().array() += kLeastRidge * normal.diagonal().maxCoeff();
  const Eigen::VectorXd solution = normal.ldlt().solve(equations.right);

  LinearSpline fit{space, solution.head(space.size()), {}, 0, {Eigen::Vector3d::Zero()}};
  for (int photo = 1; photo <= last_photo; ++photo) {
    fit.motions.emplace_back(solution.segment<kMotions>(MotionColumn(space, photo)));
  }
  WithDegree(space.degree, [&](auto degree) { FillResiduals<degree()>(points, spans, fit); });
  return fit;
}

void SortAlong(std::vector<FlatPoint>& points) {
  const auto before = [](const FlatPoint& a, const FlatPoint& b) { return a.u < b.u; };
  // Edges mostly come in order; looking first is cheaper than sorting.
  if (std::is_sorted(points.begin(), points.end(), before)) return;
  std::stable_sort(points.begin(), points.end(), before);
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
  SortAlong(flat);
  return flat;
}

}  // namespace bladecurve
