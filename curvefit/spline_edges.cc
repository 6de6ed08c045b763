// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <ceres/cost_function.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "curvefit/edge_frame.h"
#include "curvefit/residuals.h"
#include "curvefit/spline_shape.h"

namespace bladecurve {
namespace {

// Pivots with less than this part of the information are rounding noise.
constexpr double kNoise = 1e-13;

// Of a point, beside the powers of t: derivatives by angle and offset of its edge, and the
// residual.
constexpr int kExtra = 3;

// J^T J, J^T r and r^T r of all points of a photograph, over the spline's coefficients and the
// places of its edges.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  double squares = 0;

  // The points of one span; `columns` by coefficients from `first` on, then by the place of the
  // edge.
  void Add(const Eigen::MatrixXd& products,
           const Eigen::MatrixXd& columns,
           int first,
           int first_place) {
    const Eigen::Index sums = columns.rows(), basis = columns.cols() - kEdgeSize;
    const Eigen::MatrixXd by_sums = columns.transpose().lazyProduct(products.topRows(sums));
    const Eigen::MatrixXd all = by_sums.leftCols(sums).lazyProduct(columns);
    matrix.block(first, first, basis, basis) += all.topLeftCorner(basis, basis);
    matrix.block(first_place, first, kEdgeSize, basis) += all.bottomLeftCorner(kEdgeSize, basis);
    matrix.block(first, first_place, basis, kEdgeSize) += all.topRightCorner(basis, kEdgeSize);
    matrix.block<kEdgeSize, kEdgeSize>(first_place, first_place) +=
        all.bottomRightCorner<kEdgeSize, kEdgeSize>();
    right.segment(first, basis) += by_sums.col(sums).head(basis);
    right.segment<kEdgeSize>(first_place) += by_sums.col(sums).tail<kEdgeSize>();
    squares += products(sums, sums);
  }
};

class SplineEdges final : public ceres::CostFunction {
 public:
  SplineEdges(const PhotoData& photo,
              SplineSpace space,
              Loss loss,
              bool mirror,
              const SplineEdgesStart& start)
      : space_(std::move(space)),
        spans_(SpansOf(space_)),
        loss_(loss),
        held_(start.first_pose),
        is_first_(!start.own_pose) {
    *mutable_parameter_block_sizes() = {space_.size() - 1, 1, 1, kPoseSize};
    if (!is_first_) mutable_parameter_block_sizes()->push_back(kPoseSize);
    AddEdge(photo.upper, true, start);
    if (mirror) AddEdge(photo.lower, false, start);
    set_num_residuals(Columns() + 1);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const final {
    const PlacedPoint end =
        PlacePoint(held_, parameters[3], EndInBlade(*parameters[1], *parameters[2]));
    const SplineCoefficients c = CoefficientsOf(space_, parameters[0], end.point);
    if (!c.value.allFinite()) return false;
    std::vector<EdgePlacement> places;
    for (const Edge& edge : edges_) {
      places.push_back(PlaceEdge(held_, parameters[3], OwnPose(parameters), edge.is_upper));
    }
    Eigen::Map<Eigen::VectorXd> out(residuals, num_residuals());
    if (jacobians == nullptr) {
      out.setZero();
      out(num_residuals() - 1) = std::sqrt(Squares(c.value, places));
      return std::isfinite(out(num_residuals() - 1));
    }
    const Eigen::MatrixXd chain = ByParameters(c, end, places, parameters);
    WriteBlocks(Condense(Assemble(c.value, places), out) * chain, jacobians);
    return out.allFinite();
  }

 private:
  struct Edge {
    const EdgeSamples& samples;
    bool is_upper;
    std::vector<Eigen::Vector2d> directions;  // of the edge at each point, in the photograph; held
  };

  void AddEdge(const EdgeSamples& samples, bool is_upper, const SplineEdgesStart& start) {
    const Pose& pose = start.own_pose.value_or(start.first_pose);
    const EdgeFrame frame(PlaceEdge(held_, held_.data(), pose.data(), is_upper).pose, is_upper);
    const std::vector<Piece> pieces = PiecesOf(spans_, space_.degree, start.coefficients);
    Edge edge{samples, is_upper, {}};
    edge.directions.reserve(samples.points.size());
    size_t span = 0;
    for (const Eigen::Vector2d& point : samples.points) {
      const double u = frame.InSpline(point).x();
      span = FindSpan(spans_, u, span);
      const double t = (u - spans_[span].centre) * spans_[span].scale;
      edge.directions.push_back(frame.Direction(Horner<kMaxSplineDegree>(pieces[span].slope, t)));
    }
    edges_.push_back(std::move(edge));
  }

  [[nodiscard]] const double* OwnPose(double const* const* parameters) const {
    return parameters[is_first_ ? 3 : 4];
  }

  // Of the normal equations: coefficients, then the place of each edge.
  [[nodiscard]] int Columns() const {
    return space_.size() + kEdgeSize * static_cast<int>(edges_.size());
  }

  [[nodiscard]] double Squares(const Eigen::VectorXd& coefficients,
                               const std::vector<EdgePlacement>& places) const {
    const std::vector<Piece> pieces = PiecesOf(spans_, space_.degree, coefficients);
    double sum = 0;
    for (size_t e = 0; e < edges_.size(); ++e) {
      const EdgeFrame frame(places[e].pose, edges_[e].is_upper);
      WithDegree(space_.degree,
                 [&](auto degree) { sum += SquaresOf<degree()>(edges_[e], frame, pieces); });
    }
    return sum;
  }

  template <int Degree>
  [[nodiscard]] double SquaresOf(const Edge& edge,
                                 const EdgeFrame& frame,
                                 const std::vector<Piece>& pieces) const {
    double sum = 0;
    size_t span = 0;
    for (int i = 0; i < edge.samples.size(); ++i) {
      const Eigen::Vector2d p = frame.InSpline(edge.samples.points[i]);
      span = FindSpan(spans_, p.x(), span);
      const double t = (p.x() - spans_[span].centre) * spans_[span].scale;
      const double above = p.y() - Horner<Degree>(pieces[span].value, t);
      const double off = frame.Off(above * frame.Cosine(edge.directions[i]));
      const double r = Soften(loss_, edge.samples.weights[i] * off).value;
      sum += r * r;
    }
    return sum;
  }

  [[nodiscard]] NormalEquations Assemble(const Eigen::VectorXd& coefficients,
                                         const std::vector<EdgePlacement>& places) const {
    const int size = Columns();
    const std::vector<Piece> pieces = PiecesOf(spans_, space_.degree, coefficients);
    NormalEquations equations{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0};
    for (size_t e = 0; e < edges_.size(); ++e) {
      const EdgeFrame frame(places[e].pose, edges_[e].is_upper);
      const int first_place = space_.size() + kEdgeSize * static_cast<int>(e);
      WithDegree(space_.degree, [&](auto degree) {
        AddPoints<degree()>(edges_[e], frame, pieces, first_place, equations);
      });
    }
    return equations;
  }

  template <int Degree>
  void AddPoints(const Edge& edge,
                 const EdgeFrame& frame,
                 const std::vector<Piece>& pieces,
                 int first_place,
                 NormalEquations& equations) const {
    using Sums = SpanSums<Degree, kExtra>;
    Sums sums;
    size_t span = 0;
    const auto flush = [&] {
      const auto columns = frame.Columns<Degree>(spans_[span], pieces[span]);
      equations.Add(sums.AllProducts(), columns, static_cast<int>(span), first_place);
      sums = Sums();
    };
    for (int i = 0; i < edge.samples.size(); ++i) {
      const Eigen::Vector2d p = frame.InSpline(edge.samples.points[i]);
      const size_t here = FindSpan(spans_, p.x(), span);
      if (here != span) {
        flush();
        span = here;
      }
      const double t = (p.x() - spans_[span].centre) * spans_[span].scale;
      const double above = p.y() - Horner<Degree>(pieces[span].value, t);
      const double slope = Horner<Degree - 1>(pieces[span].slope, t);
      const Eigen::Vector2d& direction = edge.directions[i];
      const double cosine = frame.Cosine(direction), weight = edge.samples.weights[i];
      const SoftResidual r = Soften(loss_, weight * frame.Off(above * cosine));
      const double w = r.slope * frame.InPhoto(weight);
      const double by_angle =
          above * frame.CosineByAngle(direction) + cosine * frame.AboveByAngle(p, slope);
      sums.Add(t, -w * cosine, {w * by_angle, w, r.value});
    }
    flush();
  }

  // J^T J = S P^T L D L^T P S, pivoted, so sqrt(D) L^T P S is a Jacobian with the same normal
  // equations. Writes the residuals that go with it.
  static Eigen::MatrixXd Condense(const NormalEquations& equations,
                                  Eigen::Map<Eigen::VectorXd>& out) {
    const Eigen::Index size = equations.right.size();
    Eigen::VectorXd scale = equations.matrix.diagonal().cwiseSqrt();
    for (double& s : scale) s = s > 0 ? s : 1;
    const Eigen::VectorXd inverse = scale.cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(inverse.asDiagonal() * equations.matrix *
                                            inverse.asDiagonal());
    Eigen::VectorXd residual = ldlt.transpositionsP() * (inverse.asDiagonal() * equations.right);
    ldlt.matrixL().solveInPlace(residual);
    Eigen::VectorXd root = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      if (ldlt.vectorD()(i) > kNoise) root(i) = std::sqrt(ldlt.vectorD()(i));
      residual(i) = root(i) > 0 ? residual(i) / root(i) : 0;
    }
    out.head(size) = residual;
    out(size) = std::sqrt(std::max(0.0, equations.squares - residual.squaredNorm()));
    const Eigen::MatrixXd permuted = ldlt.transpositionsP() * Eigen::MatrixXd(scale.asDiagonal());
    return root.asDiagonal() * (ldlt.matrixU() * permuted);
  }

  // The columns of the normal equations by the parameter blocks, one after the other.
  [[nodiscard]] Eigen::MatrixXd ByParameters(const SplineCoefficients& c,
                                             const PlacedPoint& end,
                                             const std::vector<EdgePlacement>& places,
                                             double const* const* parameters) const {
    const int n = space_.size(), first_pose = n + 1,
              own_pose = first_pose + (is_first_ ? 0 : kPoseSize);
    Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(Columns(), own_pose + kPoseSize);
    chain.topLeftCorner(n, n - 1) = c.jacobian.leftCols(n - 1);
    const Eigen::MatrixXd by_end = c.jacobian.rightCols(2);
    chain.block(0, n - 1, n, 2) =
        by_end * end.by_point * EndJacobian(*parameters[1], *parameters[2]);
    constexpr std::array<int, 4> kOfFirst = {kPivotX, kPivotY, kUpperAngle, kScale};
    for (int k = 0; k < 4; ++k) {
      chain.block(0, first_pose + kOfFirst[k], n, 1) += by_end * end.by_first.col(k);
    }
    for (size_t e = 0; e < edges_.size(); ++e) {
      const int row = n + kEdgeSize * static_cast<int>(e);
      for (int k = 0; k < 4; ++k) {
        chain.block<kEdgeSize, 1>(row, first_pose + kOfFirst[k]) += places[e].by_first.col(k);
      }
      const std::array<int, kEdgeSize> of_own = {
          kPivotX, kPivotY, edges_[e].is_upper ? kUpperAngle : kLowerAngle, kScale, kOffset};
      for (int k = 0; k < kEdgeSize; ++k) {
        chain.block<kEdgeSize, 1>(row, own_pose + of_own[k]) += places[e].by_own.col(k);
      }
    }
    return chain;
  }

  // The last residual depends on no parameter: its row is 0.
  void WriteBlocks(const Eigen::MatrixXd& jacobian, double** out) const {
    Eigen::Index column = 0;
    for (size_t block = 0; block < parameter_block_sizes().size(); ++block) {
      const int size = parameter_block_sizes()[block];
      if (out[block] != nullptr) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> map(
            out[block], num_residuals(), size);
        map.topRows(jacobian.rows()) = jacobian.middleCols(column, size);
        map.bottomRows(1).setZero();
      }
      column += size;
    }
  }

  SplineSpace space_;
  std::vector<Span> spans_;
  Loss loss_;
  Pose held_;  // of the first photograph: where the spline's frame is
  bool is_first_;
  std::vector<Edge> edges_;
};

}  // namespace

ceres::CostFunction* NewSplineEdges(const PhotoData& photo,
                                    const SplineSpace& space,
                                    Loss loss,
                                    bool mirror,
                                    const SplineEdgesStart& start) {
  return new SplineEdges(photo, space, loss, mirror, start);
}

}  // namespace bladecurve
