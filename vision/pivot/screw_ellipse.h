// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <optional>

namespace bladecurve {

// The ellipse { center + shape * u : |u| = 1 }, shape symmetric and positive definite: its
// eigenvalues are the semi-axes. Unlike (semi-axes, angle) these five numbers stay well defined
// where the ellipse is a circle.
struct RimEllipse {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();

  [[nodiscard]] static RimEllipse Circle(const Eigen::Vector2d& center, double radius) {
    return {center, radius * Eigen::Matrix2d::Identity()};
  }
  // Of the circle of equal area.
  [[nodiscard]] double MeanRadius() const { return std::sqrt(std::abs(shape.determinant())); }
  // Minor, major: the eigenvalues of a symmetric 2 x 2 matrix in closed form.
  [[nodiscard]] Eigen::Vector2d SemiAxes() const {
    const double mean = 0.5 * (shape(0, 0) + shape(1, 1));
    const double spread = std::hypot(0.5 * (shape(0, 0) - shape(1, 1)), shape(0, 1));
    return {mean - spread, mean + spread};
  }
  // Minor over major semi-axis of what shows as this ellipse, seen from straight above, where
  // `view` is known: d image / d plane.
  [[nodiscard]] double AxisRatioFromAbove(const std::optional<Eigen::Matrix2d>& view) const {
    const Eigen::Matrix2d flat = view ? Eigen::Matrix2d(view->inverse() * shape) : shape;
    const Eigen::Vector2d axes = Eigen::JacobiSVD<Eigen::Matrix2d>(flat).singularValues();
    return axes[1] / axes[0];
  }
  // Of the major axis, from +x towards +y, in (-pi/2, pi/2].
  [[nodiscard]] double MajorAngle() const {
    return 0.5 * std::atan2(2 * shape(0, 1), shape(0, 0) - shape(1, 1));
  }
  [[nodiscard]] Eigen::Vector2d PointAt(const Eigen::Vector2d& u) const {
    return center + shape * u;
  }
  // The same ellipse in coordinates q = (p - origin) / scale.
  [[nodiscard]] RimEllipse Into(const Eigen::Vector2d& origin, double scale) const {
    return {(center - origin) / scale, shape / scale};
  }
  [[nodiscard]] RimEllipse OutOf(const Eigen::Vector2d& origin, double scale) const {
    return {origin + scale * center, scale * shape};
  }
};

}  // namespace bladecurve
