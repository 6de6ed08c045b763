// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <ceres/cost_function.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "curvefit/residuals.h"

namespace bladecurve {
namespace {

constexpr int kPoseColumns = 5;  // pivot x, y, angle of the blade, scale, offset
constexpr int kLocalSize = kMaxSplineDegree + 1 + kPoseColumns + 1;  // and the residual
// Directions with less than this part of the information are rounding noise.
constexpr double kNoise = 1e-13;

using LocalRow = Eigen::Matrix<double, kLocalSize, 1>;
using LocalMatrix = Eigen::Matrix<double, kLocalSize, kLocalSize>;

// J^T J, J^T r and r^T r of all points of a photograph, over spline coefficients and pose.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  double squares = 0;
};

// Turns points of one edge into its blade's frame and gives the rows of the Jacobian there.
class EdgeFrame {
 public:
  EdgeFrame(const double* pose, bool is_upper)
      : pose_(pose), angle_(is_upper ? kUpperAngle : kLowerAngle), side_(is_upper ? 1 : -1) {
    cosine_ = std::cos(pose[angle_]);
    sine_ = std::sin(pose[angle_]);
  }

  [[nodiscard]] PoseIndex angle() const { return angle_; }

  [[nodiscard]] Eigen::Vector2d Turned(const Eigen::Vector2d& z) const {
    return {cosine_ * z.x() + sine_ * z.y(), side_ * (cosine_ * z.y() - sine_ * z.x())};
  }

  [[nodiscard]] Eigen::Vector2d InBlade(const Eigen::Vector2d& point) const {
    return Turned((1 + pose_[kScale]) * point - Eigen::Vector2d(pose_[kPivotX], pose_[kPivotY]));
  }

  // A length of the blade in the photograph's own lengths, in which its sigmas stand; residuals in
  // mm of the blade would all shrink with the scale, and a smaller scale alone would fit better.
  [[nodiscard]] double InPhoto(double length) const { return length / (1 + pose_[kScale]); }

  // Direction in the photograph of an edge of this slope in the blade's frame.
  [[nodiscard]] Eigen::Vector2d Direction(double slope) const {
    const double along = 1 / std::sqrt(1 + slope * slope), up = side_ * along * slope;
    return {cosine_ * along - sine_ * up, sine_ * along + cosine_ * up};
  }
  // cos of the inclination that a direction of the photograph has in the blade's frame.
  [[nodiscard]] double Cosine(const Eigen::Vector2d& direction) const {
    return direction.x() * cosine_ + direction.y() * sine_;
  }

  // Derivatives of InPhoto(distance + offset) by the five pose columns, times 1 + scale.
  void PoseColumns(const SplineDistance& distance,
                   const Eigen::Vector2d& direction,
                   const Eigen::Vector2d& point,
                   const Eigen::Vector2d& in_blade,
                   double* out) const {
    const double du = distance.d_u, dv = side_ * distance.d_v;
    const double above = distance.d / distance.d_v;
    const double cosine_by_angle = direction.y() * cosine_ - direction.x() * sine_;
    const Eigen::Vector2d turned = Turned(point);
    out[0] = -cosine_ * du + sine_ * dv;
    out[1] = -sine_ * du - cosine_ * dv;
    out[2] = side_ * in_blade.y() * du - in_blade.x() * dv + above * cosine_by_angle;
    out[3] = turned.x() * du + turned.y() * distance.d_v - InPhoto(distance.d + pose_[kOffset]);
    out[4] = 1;
  }

 private:
  const double* pose_;
  PoseIndex angle_;
  double side_, cosine_, sine_;
};

class SplineEdges final : public ceres::CostFunction {
 public:
  SplineEdges(const PhotoData& photo,
              SplineSpace space,
              Loss loss,
              bool mirror,
              const SplineEdgesStart& start)
      : photo_(photo), space_(std::move(space)), table_(space_), loss_(loss), mirror_(mirror) {
    *mutable_parameter_block_sizes() = {space_.size() - 1, 1, 1, kPoseSize};
    set_num_residuals(space_.size() + kPoseSize + 1);
    upper_directions_ =
        Directions(photo.upper, EdgeFrame(start.pose.data(), true), start.coefficients);
    if (!mirror) return;
    lower_directions_ =
        Directions(photo.lower, EdgeFrame(start.pose.data(), false), start.coefficients);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const final {
    const SplineCoefficients c =
        CoefficientsOf(space_, parameters[0], *parameters[1], *parameters[2]);
    if (!c.value.allFinite()) return false;
    const double* pose = parameters[3];
    Eigen::Map<Eigen::VectorXd> out(residuals, num_residuals());
    if (jacobians == nullptr) {
      out.setZero();
      out(num_residuals() - 1) = std::sqrt(Squares(c.value.data(), pose));
      return std::isfinite(out(num_residuals() - 1));
    }
    Condense(Assemble(c.value.data(), pose), c.jacobian, out, jacobians);
    return out.allFinite();
  }

 private:
  [[nodiscard]] std::vector<Eigen::Vector2d> Directions(const EdgeSamples& edge,
                                                        const EdgeFrame& frame,
                                                        const Eigen::VectorXd& coefficients) const {
    std::vector<Eigen::Vector2d> directions;
    directions.reserve(edge.points.size());
    for (const Eigen::Vector2d& point : edge.points) {
      const BasisRow row = table_.At(frame.InBlade(point).x());
      const double slope = SlopeAt(row, space_.degree, coefficients.data());
      directions.push_back(frame.Direction(slope));
    }
    return directions;
  }

  [[nodiscard]] double Squares(const double* coefficients, const double* pose) const {
    double sum =
        SquaresOf(photo_.upper, upper_directions_, EdgeFrame(pose, true), coefficients, pose);
    if (mirror_)
      sum += SquaresOf(photo_.lower, lower_directions_, EdgeFrame(pose, false), coefficients, pose);
    return sum;
  }

  [[nodiscard]] double SquaresOf(const EdgeSamples& edge,
                                 const std::vector<Eigen::Vector2d>& directions,
                                 const EdgeFrame& frame,
                                 const double* coefficients,
                                 const double* pose) const {
    double sum = 0;
    for (int i = 0; i < edge.size(); ++i) {
      const Eigen::Vector2d p = frame.InBlade(edge.points[i]);
      const BasisRow row = table_.At(p.x());
      double above = p.y();
      for (int j = 0; j <= space_.degree; ++j) {
        above -= row.value[j] * coefficients[row.first + j];
      }
      const double d = above * frame.Cosine(directions[i]);
      const double r = Soften(loss_, edge.weights[i] * frame.InPhoto(d + pose[kOffset])).value;
      sum += r * r;
    }
    return sum;
  }

  [[nodiscard]] NormalEquations Assemble(const double* coefficients, const double* pose) const {
    const int size = space_.size() + kPoseSize;
    NormalEquations equations{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0};
    AddEdge(photo_.upper, upper_directions_, EdgeFrame(pose, true), coefficients, pose, equations);
    if (mirror_)
      AddEdge(
          photo_.lower, lower_directions_, EdgeFrame(pose, false), coefficients, pose, equations);
    return equations;
  }

  // Points of one span share their columns: they are summed in a small matrix of fixed size.
  void AddEdge(const EdgeSamples& edge,
               const std::vector<Eigen::Vector2d>& directions,
               const EdgeFrame& frame,
               const double* coefficients,
               const double* pose,
               NormalEquations& equations) const {
    LocalMatrix local = LocalMatrix::Zero();
    int first = -1;
    for (int i = 0; i < edge.size(); ++i) {
      const Eigen::Vector2d p = frame.InBlade(edge.points[i]);
      const SplineDistance distance = DistanceFrom(
          table_.At(p.x()), space_.degree, coefficients, p.y(), frame.Cosine(directions[i]));
      if (distance.first != first) {
        Flush(local, first, frame.angle(), equations);
        first = distance.first;
      }
      const SoftResidual r =
          Soften(loss_, edge.weights[i] * frame.InPhoto(distance.d + pose[kOffset]));
      LocalRow row = LocalRow::Zero();
      for (int j = 0; j <= space_.degree; ++j) row(j) = distance.d_c[j];
      frame.PoseColumns(
          distance, directions[i], edge.points[i], p, row.data() + kMaxSplineDegree + 1);
      row *= r.slope * frame.InPhoto(edge.weights[i]);
      row(kLocalSize - 1) = r.value;
      for (int k = 0; k < kLocalSize; ++k) local.col(k) += row(k) * row;
    }
    Flush(local, first, frame.angle(), equations);
  }

  void Flush(LocalMatrix& local, int first, PoseIndex angle, NormalEquations& equations) const {
    const int n = space_.size();
    std::array<int, kLocalSize> column{};
    for (int j = 0; j <= kMaxSplineDegree; ++j) column[j] = j <= space_.degree ? first + j : -1;
    const std::array<int, kPoseColumns> pose = {kPivotX, kPivotY, angle, kScale, kOffset};
    for (int k = 0; k < kPoseColumns; ++k) column[kMaxSplineDegree + 1 + k] = n + pose[k];
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
  // equations.
  void Condense(const NormalEquations& equations,
                const Eigen::MatrixXd& shape_jacobian,
                Eigen::Map<Eigen::VectorXd>& out,
                double** jacobians) const {
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
    const Eigen::MatrixXd jacobian = root.asDiagonal() * turned * scale.asDiagonal();
    const Eigen::VectorXd residual =
        reciprocal.asDiagonal() * (turned * (inverse.asDiagonal() * equations.right));
    out.head(size) = residual;
    out(size) = std::sqrt(std::max(0.0, equations.squares - residual.squaredNorm()));
    const int n = space_.size();
    const Eigen::MatrixXd shape = jacobian.leftCols(n) * shape_jacobian;
    WriteBlock(shape.leftCols(n - 1), jacobians[0]);
    WriteBlock(shape.col(n - 1), jacobians[1]);
    WriteBlock(shape.col(n), jacobians[2]);
    WriteBlock(jacobian.rightCols(kPoseSize), jacobians[3]);
  }

  static void WriteBlock(const Eigen::MatrixXd& block, double* out) {
    if (out == nullptr) return;
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      for (Eigen::Index j = 0; j < block.cols(); ++j) *out++ = block(i, j);
    }
    for (Eigen::Index j = 0; j < block.cols(); ++j) *out++ = 0;
  }

  const PhotoData& photo_;
  SplineSpace space_;
  BasisTable table_;
  Loss loss_;
  bool mirror_;
  // Of the edge at each point, in the photograph; held.
  std::vector<Eigen::Vector2d> upper_directions_, lower_directions_;
};

}  // namespace

double SlopeAt(const BasisRow& row, int degree, const double* coefficients) {
  double slope = 0;
  for (int j = 0; j <= degree; ++j) slope += row.slope[j] * coefficients[row.first + j];
  return slope;
}

SplineDistance DistanceFrom(
    const BasisRow& row, int degree, const double* coefficients, double v, double cosine) {
  double above = v, slope = 0;
  SplineDistance distance;
  for (int j = 0; j <= degree; ++j) {
    const double c = coefficients[row.first + j];
    above -= row.value[j] * c;
    slope += row.slope[j] * c;
    distance.d_c[j] = -cosine * row.value[j];
  }
  distance.first = row.first;
  distance.d = above * cosine;
  distance.d_v = cosine;
  distance.d_u = -slope * cosine;
  return distance;
}

SplineCoefficients CoefficientsOf(const SplineSpace& space,
                                  const double* free,
                                  double reach,
                                  double zero) {
  const int n = space.size();
  Eigen::VectorXd t = Eigen::VectorXd::Zero(n);
  for (int j = 0; j < n - 1; ++j) t(j) = free[j];
  const BasisRow row = EvalBasis(space, reach);
  Eigen::VectorXd basis = Eigen::VectorXd::Zero(n);
  double slope = 0;
  for (int j = 0; j <= space.degree; ++j) {
    basis(row.first + j) = row.value[j];
    slope += row.slope[j] * t(row.first + j);
  }
  const std::vector<double> abscissae = GrevilleAbscissae(space);
  const Eigen::Map<const Eigen::VectorXd> xi(abscissae.data(), n);
  const double end = basis.dot(t), half = std::tan(zero / 2);
  SplineCoefficients c;
  c.value = t - xi * (end / reach + half);
  c.jacobian = Eigen::MatrixXd::Zero(n, n + 1);
  c.jacobian.leftCols(n - 1).setIdentity();
  c.jacobian.leftCols(n - 1) -= xi * basis.head(n - 1).transpose() / reach;
  c.jacobian.col(n - 1) = -xi * (slope - end / reach) / reach;
  c.jacobian.col(n) = -xi * 0.5 * (1 + half * half);
  return c;
}

SplineParameters ParametersOf(const SplineSpace& space,
                              const Eigen::VectorXd& coefficients,
                              double reach,
                              double zero) {
  const int n = space.size();
  const std::vector<double> xi = GrevilleAbscissae(space);
  SplineParameters parameters{{}, reach, zero};
  const double slope = coefficients(n - 1) / xi[n - 1];
  for (int j = 0; j < n - 1; ++j) parameters.free.push_back(coefficients(j) - slope * xi[j]);
  return parameters;
}

ceres::CostFunction* NewSplineEdges(const PhotoData& photo,
                                    const SplineSpace& space,
                                    Loss loss,
                                    bool mirror,
                                    const SplineEdgesStart& start) {
  return new SplineEdges(photo, space, loss, mirror, start);
}

}  // namespace bladecurve
