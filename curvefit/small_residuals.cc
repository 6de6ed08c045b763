// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <ceres/autodiff_cost_function.h>

#include <Eigen/Geometry>

#include "curvefit/residuals.h"

namespace bladecurve {
namespace {

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

struct PoseObservations {
  const PhotoData& photo;

  template <typename T>
  Vector2<T> FromPivot(const Eigen::Vector2d& point, const T* pose) const {
    return (T(1) + pose[kScale]) * point.cast<T>() - Vector2<T>(pose[kPivotX], pose[kPivotY]);
  }

  // The upper end lies at (reach, -reach tan(zero/2)) of its blade's frame, and is seen as far out
  // of the blade as the edge, across the edge: across the ray, edge and end would be seen to part.
  template <typename T>
  Vector2<T> UpperEnd(const T& reach, const T& zero, const T* pose) const {
    using std::cos, std::sin, std::tan;
    const T c = cos(pose[kUpperAngle]), s = sin(pose[kUpperAngle]);
    const T v = -reach * tan(T(0.5) * zero);
    const Vector2<T> end(c * reach - s * v, s * reach + c * v);
    return photo.upper_end_whitener.cast<T>() *
           (FromPivot(photo.upper_end, pose) - end - pose[kOffset] * photo.upper_end_out.cast<T>());
  }

  // How far the lower end lies from its ray, wherever on it: the blades may differ in length. In
  // sigmas across the ray as it now runs; held sigmas would have the pivot move to where the ray
  // passes both ends, however far apart these are along the edge.
  template <typename T>
  T LowerEnd(const T& zero, const T* pose) const {
    using std::cos, std::sin, std::sqrt;
    if (!photo.lower_end) return T(0);
    const T ray = pose[kLowerAngle] + T(0.5) * zero;
    const Vector2<T> across(-sin(ray), cos(ray));
    const Vector2<T> spread = photo.lower_end_root.transpose().cast<T>() * across;
    const Vector2<T> end =
        FromPivot(*photo.lower_end, pose) - pose[kOffset] * photo.lower_end_out.cast<T>();
    const T off_ray = end.dot(across);
    return off_ray / sqrt(spread.squaredNorm());
  }

  template <typename T>
  T Theta(const T& zero, const T* pose) const {
    if (!photo.theta) return T(0);
    const T theta = pose[kUpperAngle] - pose[kLowerAngle];
    return photo.theta_weight * ((photo.theta_given ? theta : theta - zero) - *photo.theta);
  }

  template <typename T>
  bool operator()(const T* reach, const T* zero, const T* pose, T* residuals) const {
    Eigen::Map<Eigen::Matrix<T, 8, 1>> r(residuals);
    const Vector2<T> pivot(pose[kPivotX], pose[kPivotY]);
    const T grown =
        T(1) + pose[kScale];  // distances in the photograph's own lengths, as its sigmas
    r.template segment<2>(0) = photo.pivot_whitener.cast<T>() * pivot / grown;
    r.template segment<2>(2) = UpperEnd(*reach, *zero, pose) / grown;
    r(4) = LowerEnd(*zero, pose) / grown;
    r(5) = Theta(*zero, pose);
    r(6) = photo.scale_weight * pose[kScale];
    r(7) = photo.offset_weight * pose[kOffset];
    return true;
  }
};

// The rows (x, y, 1) of an edge times its weights, condensed to 3 rows with the same sums of
// squares and products: a straight edge's residual is linear in the row, so nothing is lost.
// Modified Gram-Schmidt, the ones first: as good as Householder's for this, and three passes only.
Eigen::Matrix3d CondensedRows(const EdgeSamples& edge) {
  Eigen::MatrixX3d all(edge.size(), 3);  // columns: 1, x, y
  for (int i = 0; i < edge.size(); ++i) {
    all.row(i) = edge.weights[i] * Eigen::RowVector3d(1, edge.points[i].x(), edge.points[i].y());
  }
  Eigen::Matrix3d root = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    root(k, k) = all.col(k).norm();
    if (root(k, k) == 0) continue;
    all.col(k) /= root(k, k);
    for (int j = k + 1; j < 3; ++j) {
      root(k, j) = all.col(k).dot(all.col(j));
      all.col(j) -= root(k, j) * all.col(k);
    }
  }
  return (Eigen::Matrix3d() << root.col(1), root.col(2), root.col(0)).finished();
}

struct TaperedEdges {
  Eigen::Matrix3d upper, lower;

  // Distance = line . (x, y, 1) for a point (x, y) of the photograph, offset included.
  template <typename T>
  Eigen::Matrix<T, 3, 1> Line(const T* ab, const T& gain, const T* pose, double side) const {
    using std::cos, std::sin, std::sqrt, std::tan;
    const T axis = T(0.5) * (pose[kUpperAngle] + pose[kLowerAngle]);
    const T half = T(0.5) * (pose[kUpperAngle] - pose[kLowerAngle]);
    const T slope = ab[1] + gain * tan(half);
    const T g = T(1) / sqrt(T(1) + slope * slope);
    const T c = cos(axis), s = sin(axis);
    // x = c zx + s zy, y = side (c zy - s zx), z = (1 + scale) point - pivot
    const T zx = g * (-side * s - slope * c), zy = g * (side * c - slope * s);
    // In the photograph's own lengths, in which its sigmas stand; else a smaller scale alone would
    // fit better.
    const T grown = T(1) + pose[kScale];
    return {zx, zy, (-zx * pose[kPivotX] - zy * pose[kPivotY] - g * ab[0] + pose[kOffset]) / grown};
  }

  template <typename T>
  bool operator()(const T* ab, const T* gain, const T* pose, T* residuals) const {
    Eigen::Map<Eigen::Matrix<T, 6, 1>> r(residuals);
    r.template head<3>() = upper.cast<T>() * Line(ab, *gain, pose, 1);
    r.template tail<3>() = lower.cast<T>() * Line(ab, *gain, pose, -1);
    return true;
  }
};

}  // namespace

ceres::CostFunction* NewPoseObservations(const PhotoData& photo) {
  return new ceres::AutoDiffCostFunction<PoseObservations, 8, 1, 1, kPoseSize>(
      new PoseObservations{photo});
}

ceres::CostFunction* NewTaperedEdges(const PhotoData& photo, bool mirror) {
  return new ceres::AutoDiffCostFunction<TaperedEdges, 6, 2, 1, kPoseSize>(new TaperedEdges{
      CondensedRows(photo.upper),
      mirror ? CondensedRows(photo.lower) : Eigen::Matrix3d(Eigen::Matrix3d::Zero())});
}

}  // namespace bladecurve
