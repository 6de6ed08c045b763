// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <ceres/cost_function.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "curvefit/residuals.h"
#include "curvefit/spline_frame.h"
#include "curvefit/spline_shape.h"

namespace bladecurve {
namespace {

constexpr int kLocalSize = kMaxSplineDegree + 1 + kEdgeSize + 1;  // and the residual
// Directions with less than this part of the information are rounding noise.
constexpr double kNoise = 1e-13;

using LocalRow = Eigen::Matrix<double, kLocalSize, 1>;
using LocalMatrix = Eigen::Matrix<double, kLocalSize, kLocalSize>;

enum EdgeIndex { kEdgePivotX, kEdgePivotY, kEdgeAngle, kEdgeScale, kEdgeOffset };

// J^T J, J^T r and r^T r of all points of a photograph, over the spline's coefficients and the
// places of its edges.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  double squares = 0;
};

// Turns points of one edge into the spline's frame and gives the rows of the Jacobian there.
class EdgeFrame {
 public:
  EdgeFrame(const EdgePose& pose, bool is_upper)
      : pose_(pose),
        side_(is_upper ? 1 : -1),
        cosine_(std::cos(pose(kEdgeAngle))),
        sine_(std::sin(pose(kEdgeAngle))) {}

  [[nodiscard]] Eigen::Vector2d Turned(const Eigen::Vector2d& z) const {
    return {cosine_ * z.x() + sine_ * z.y(), side_ * (cosine_ * z.y() - sine_ * z.x())};
  }

  [[nodiscard]] Eigen::Vector2d InSpline(const Eigen::Vector2d& point) const {
    return Turned((1 + pose_(kEdgeScale)) * point - pose_.head<2>());
  }

  // A length of the spline in the photograph's own lengths, in which its sigmas stand; residuals in
  // mm of the blade would all shrink with the scale, and a smaller scale alone would fit better.
  [[nodiscard]] double InPhoto(double length) const { return length / (1 + pose_(kEdgeScale)); }

  // The residual of a point at this distance from the spline, not yet weighted.
  [[nodiscard]] double Off(double distance) const { return InPhoto(distance + pose_(kEdgeOffset)); }

  // Direction in the photograph of an edge of this slope in the spline's frame.
  [[nodiscard]] Eigen::Vector2d Direction(double slope) const {
    const double along = 1 / std::sqrt(1 + slope * slope), up = side_ * along * slope;
    return {cosine_ * along - sine_ * up, sine_ * along + cosine_ * up};
  }
  // cos of the inclination that a direction of the photograph has in the spline's frame.
  [[nodiscard]] double Cosine(const Eigen::Vector2d& direction) const {
    return direction.x() * cosine_ + direction.y() * sine_;
  }

  // Derivatives of Off(distance) by the edge's pose, times 1 + scale.
  void PoseColumns(const SplineDistance& distance,
                   const Eigen::Vector2d& direction,
                   const Eigen::Vector2d& point,
                   const Eigen::Vector2d& in_spline,
                   double* out) const {
    const double du = distance.d_u, dv = side_ * distance.d_v;
    const double above = distance.d / distance.d_v;
    const double cosine_by_angle = direction.y() * cosine_ - direction.x() * sine_;
    const Eigen::Vector2d turned = Turned(point);
    out[kEdgePivotX] = -cosine_ * du + sine_ * dv;
    out[kEdgePivotY] = -sine_ * du - cosine_ * dv;
    out[kEdgeAngle] = side_ * in_spline.y() * du - in_spline.x() * dv + above * cosine_by_angle;
    out[kEdgeScale] = turned.x() * du + turned.y() * distance.d_v - Off(distance.d);
    out[kEdgeOffset] = 1;
  }

 private:
  EdgePose pose_;
  double side_, cosine_, sine_;
};

class SplineEdges final : public ceres::CostFunction {
 public:
  SplineEdges(const PhotoData& photo,
              SplineSpace space,
              Loss loss,
              bool mirror,
              const SplineEdgesStart& start)
      : space_(std::move(space)),
        table_(space_),
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
    Edge edge{samples, is_upper, {}};
    edge.directions.reserve(samples.points.size());
    for (const Eigen::Vector2d& point : samples.points) {
      const BasisRow row = table_.At(frame.InSpline(point).x());
      edge.directions.push_back(
          frame.Direction(SlopeAt(row, space_.degree, start.coefficients.data())));
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
    double sum = 0;
    for (size_t e = 0; e < edges_.size(); ++e) {
      const EdgeFrame frame(places[e].pose, edges_[e].is_upper);
      sum += SquaresOf(edges_[e], frame, coefficients.data());
    }
    return sum;
  }

  [[nodiscard]] double SquaresOf(const Edge& edge,
                                 const EdgeFrame& frame,
                                 const double* coefficients) const {
    double sum = 0;
    for (int i = 0; i < edge.samples.size(); ++i) {
      const Eigen::Vector2d p = frame.InSpline(edge.samples.points[i]);
      const BasisRow row = table_.At(p.x());
      double above = p.y();
      for (int j = 0; j <= space_.degree; ++j) {
        above -= row.value[j] * coefficients[row.first + j];
      }
      const double d = above * frame.Cosine(edge.directions[i]);
      const double r = Soften(loss_, edge.samples.weights[i] * frame.Off(d)).value;
      sum += r * r;
    }
    return sum;
  }

  [[nodiscard]] NormalEquations Assemble(const Eigen::VectorXd& coefficients,
                                         const std::vector<EdgePlacement>& places) const {
    const int size = Columns();
    NormalEquations equations{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0};
    for (size_t e = 0; e < edges_.size(); ++e) {
      const EdgeFrame frame(places[e].pose, edges_[e].is_upper);
      const int first_place = space_.size() + kEdgeSize * static_cast<int>(e);
      Accumulate(edges_[e], frame, coefficients.data(), first_place, equations);
    }
    return equations;
  }

  // Points of one span share their columns: they are summed in a small matrix of fixed size.
  void Accumulate(const Edge& edge,
                  const EdgeFrame& frame,
                  const double* coefficients,
                  int first_place,
                  NormalEquations& equations) const {
    LocalMatrix local = LocalMatrix::Zero();
    int first = -1;
    for (int i = 0; i < edge.samples.size(); ++i) {
      const Eigen::Vector2d& point = edge.samples.points[i];
      const Eigen::Vector2d p = frame.InSpline(point);
      const SplineDistance distance = DistanceFrom(
          table_.At(p.x()), space_.degree, coefficients, p.y(), frame.Cosine(edge.directions[i]));
      if (distance.first != first) {
        Flush(local, first, first_place, equations);
        first = distance.first;
      }
      const double weight = edge.samples.weights[i];
      const SoftResidual r = Soften(loss_, weight * frame.Off(distance.d));
      LocalRow row = LocalRow::Zero();
      for (int j = 0; j <= space_.degree; ++j) row(j) = distance.d_c[j];
      frame.PoseColumns(distance, edge.directions[i], point, p, row.data() + kMaxSplineDegree + 1);
      row *= r.slope * frame.InPhoto(weight);
      row(kLocalSize - 1) = r.value;
      for (int k = 0; k < kLocalSize; ++k) local.col(k) += row(k) * row;
    }
    Flush(local, first, first_place, equations);
  }

  void Flush(LocalMatrix& local, int first, int first_place, NormalEquations& equations) const {
    std::array<int, kLocalSize> column{};
    for (int j = 0; j <= kMaxSplineDegree; ++j) column[j] = j <= space_.degree ? first + j : -1;
    for (int k = 0; k < kEdgeSize; ++k) column[kMaxSplineDegree + 1 + k] = first_place + k;
    constexpr int kResidual = kLocalSize - 1;
    for (int i = 0; first >= 0 && i < kResidual; ++i) {
      if (column[i] < 0) continue;
      for (int j = 0; j < kResidual; ++j) {
        if (column[j] >= 0) equations.matrix(column[i], column[j]) += local(i, j);
      }
      equations.right(column[i]) += local(i, kResidual);
    }
    equations.squares += local(kResidual, kResidual);
    local.setZero();
  }

  // J^T J = S V diag(lambda) V^T S, so sqrt(lambda) V^T S is a Jacobian with the same normal
  // equations. Writes the residuals that go with it.
  static Eigen::MatrixXd Condense(const NormalEquations& equations,
                                  Eigen::Map<Eigen::VectorXd>& out) {
    const Eigen::Index size = equations.right.size();
    Eigen::VectorXd scale = equations.matrix.diagonal().cwiseSqrt();
    for (double& s : scale) s = s > 0 ? s : 1;
    const Eigen::VectorXd inverse = scale.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        inverse.asDiagonal() * equations.matrix * inverse.asDiagonal());
    const Eigen::VectorXd& lambda = eigen.eigenvalues();
    Eigen::VectorXd root = Eigen::VectorXd::Zero(size), reciprocal = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      if (lambda(i) <= kNoise * lambda(size - 1)) continue;
      root(i) = std::sqrt(lambda(i));
      reciprocal(i) = 1 / root(i);
    }
    const Eigen::MatrixXd turned = eigen.eigenvectors().transpose();
    const Eigen::VectorXd residual =
        reciprocal.asDiagonal() * (turned * (inverse.asDiagonal() * equations.right));
    out.head(size) = residual;
    out(size) = std::sqrt(std::max(0.0, equations.squares - residual.squaredNorm()));
    return root.asDiagonal() * turned * scale.asDiagonal();
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
  BasisTable table_;
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
