// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_bound.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "vision/edge_images.h"
#include "vision/edge_unknowns.h"

namespace bladecurve::testing {
namespace {

// Pixels are laid out around (center, center).
cv::Mat Model(const Unknowns& at, int side) {
  const double center = 0.5 * (side - 1);
  const Eigen::Vector2d normal(std::cos(at[kAngle]), std::sin(at[kAngle]));
  const double offset = at[kOffset] + center * (normal.x() + normal.y());
  const cv::Mat coverage = HalfPlaneCoverage({side, side}, normal, offset, at[kBlur]);
  return at[kBlade] + (at[kGround] - at[kBlade]) * coverage;
}

}  // namespace

double OffsetBound(const BoundCase& edge) {
  // Information grows with the length; a piece of it is enough to sum over.
  constexpr double kPiece = 40;
  const double length = std::min(edge.length_px, kPiece);
  Unknowns truth;
  truth << 0.137, edge.normal_rad, 50, 50 + edge.contrast, edge.blur_px;
  const int side = static_cast<int>(length + 2 * edge.reach_px) + 3;
  std::array<cv::Mat, kUnknowns> derivatives;
  for (int k = 0; k < kUnknowns; ++k) {
    const double h = k == kAngle ? 1e-6 : 1e-4;
    Unknowns more = truth, less = truth;
    more[k] += h;
    less[k] -= h;
    derivatives[static_cast<size_t>(k)] = (Model(more, side) - Model(less, side)) / (2 * h);
  }
  const Eigen::Vector2d normal(std::cos(edge.normal_rad), std::sin(edge.normal_rad));
  const double center = 0.5 * (side - 1);
  Eigen::Matrix<double, kUnknowns, kUnknowns> fisher =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Eigen::Vector2d from_center(x - center, y - center);
      const double across = normal.dot(from_center) - truth[kOffset];
      const double along = normal.x() * from_center.y() - normal.y() * from_center.x();
      if (std::abs(across) > edge.reach_px || std::abs(along) > 0.5 * length) continue;
      Unknowns gradient;
      for (int k = 0; k < kUnknowns; ++k)
        gradient[k] = derivatives[static_cast<size_t>(k)].at<double>(y, x);
      fisher += gradient * gradient.transpose() / (edge.noise * edge.noise);
    }
  }
  return std::sqrt(fisher.inverse()(kOffset, kOffset) * length / edge.length_px);
}

}  // namespace bladecurve::testing
