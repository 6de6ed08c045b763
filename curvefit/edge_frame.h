// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "curvefit/span_sums.h"
#include "curvefit/span_table.h"
#include "curvefit/spline_frame.h"

namespace bladecurve {

enum EdgeIndex { kEdgePivotX, kEdgePivotY, kEdgeAngle, kEdgeScale, kEdgeOffset };

// Takes the points of one edge from the photograph into the spline's frame.
class EdgeFrame {
 public:
  EdgeFrame(const EdgePose& pose, bool is_upper)
      : pose_(pose),
        side_(is_upper ? 1 : -1),
        cosine_(std::cos(pose(kEdgeAngle))),
        sine_(std::sin(pose(kEdgeAngle))) {}

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

  // cos of the inclination that a direction of the photograph has in the spline's frame, and its
  // derivative by the edge's angle.
  [[nodiscard]] double Cosine(const Eigen::Vector2d& direction) const {
    return direction.x() * cosine_ + direction.y() * sine_;
  }
  [[nodiscard]] double CosineByAngle(const Eigen::Vector2d& direction) const {
    return direction.y() * cosine_ - direction.x() * sine_;
  }

  // How a point's height above the spline changes with the edge's angle.
  [[nodiscard]] double AboveByAngle(const Eigen::Vector2d& in_spline, double slope) const {
    return -side_ * (in_spline.y() * slope + in_spline.x());
  }

  // The columns of the Jacobian in one span, by coefficients and edge pose, as combinations of what
  // SpanSums holds: powers of t times w = -(weight in the spline's lengths) cos, then the column by
  // the angle and that by the offset. A shift of the edge changes distances by 1 and by the slope,
  // its scale by 1, the spline and u times the slope: all polynomials of t.
  template <int Degree>
  [[nodiscard]] Eigen::Matrix<double, Degree + 3, Degree + 1 + kEdgeSize> Columns(
      const Span& span, const Piece& piece) const {
    constexpr int kBasis = Degree + 1, kAngleSum = kBasis, kOffsetSum = kBasis + 1;
    Eigen::Matrix<double, kBasis + 2, kBasis + kEdgeSize> columns;
    columns.setZero();
    const Eigen::Vector2d pivot = Turned(pose_.head<2>());
    const double grown = 1 + pose_(kEdgeScale), u_at_0 = span.centre + pivot.x();
    for (int k = 0; k < kBasis; ++k) {
      for (int j = 0; j < kBasis; ++j) columns(k, j) = span.basis[j][k];
      columns(k, kBasis + kEdgePivotX) = -cosine_ * piece.slope[k];
      columns(k, kBasis + kEdgePivotY) = -sine_ * piece.slope[k];
      const double u_times_slope =
          u_at_0 * piece.slope[k] + (k > 0 ? piece.slope[k - 1] / span.scale : 0);
      columns(k, kBasis + kEdgeScale) = (u_times_slope - piece.value[k]) / grown;
    }
    columns(0, kBasis + kEdgePivotX) -= side_ * sine_;
    columns(0, kBasis + kEdgePivotY) += side_ * cosine_;
    columns(0, kBasis + kEdgeScale) -= pivot.y() / grown;
    columns(kAngleSum, kBasis + kEdgeAngle) = 1;
    columns(kOffsetSum, kBasis + kEdgeOffset) = 1;
    columns(kOffsetSum, kBasis + kEdgeScale) = -pose_(kEdgeOffset) / grown;
    return columns;
  }

 private:
  [[nodiscard]] Eigen::Vector2d Turned(const Eigen::Vector2d& z) const {
    return {cosine_ * z.x() + sine_ * z.y(), side_ * (cosine_ * z.y() - sine_ * z.x())};
  }

  EdgePose pose_;
  double side_, cosine_, sine_;
};

}  // namespace bladecurve
