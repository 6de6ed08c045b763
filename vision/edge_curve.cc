// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_curve.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

constexpr int kTerms =
    5;  // a quartic: blades with one bend are followed to a few tenths of a pixel
constexpr int kRounds = 12;
constexpr size_t kEnough = 300;      // points; more do not move a quartic
constexpr double kLeastSigma = 0.2;  // px; no point is worth more, whatever its noise
constexpr double kScale = 0.5;       // px; residuals beyond lose their pull (Cauchy)

using Terms = Eigen::Matrix<double, kTerms, 1>;

// Legendre polynomials at t in [-1, 1].
Terms LegendreTerms(double t) {
  Terms terms;
  terms[0] = 1;
  terms[1] = t;
  for (int n = 1; n + 1 < kTerms; ++n)
    terms[n + 1] = ((2 * n + 1) * t * terms[n] - n * terms[n - 1]) / (n + 1);
  return terms;
}

double PlaceOf(size_t i, size_t count) {
  return count > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1 : 0;
}

}  // namespace

std::vector<double> DistancesFromPlainCurve(const std::vector<LocatedEdgePoint>& points) {
  std::vector<double> distances(points.size(), 0.0);
  const size_t stride = 1 + points.size() / kEnough;
  std::vector<Terms> terms;
  for (size_t i = 0; i < points.size(); ++i)
    terms.push_back(LegendreTerms(PlaceOf(i, points.size())));
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Eigen::Matrix<double, kTerms, 2> right = Eigen::Matrix<double, kTerms, 2>::Zero();
    for (size_t i = 0; i < points.size(); i += stride) {
      const double pull = 1 / (1 + distances[i] * distances[i] / (kScale * kScale));
      const double weight =
          pull / (points[i].sigma_px * points[i].sigma_px + kLeastSigma * kLeastSigma);
      normal += weight * terms[i] * terms[i].transpose();
      right += weight * terms[i] * (points[i].point_px - points.front().point_px).transpose();
    }
    const Eigen::Matrix<double, kTerms, 2> coefficients = normal.ldlt().solve(right);
    const size_t wanted = round + 1 < kRounds ? stride : 1;
    for (size_t i = 0; i < points.size(); i += wanted) {
      const Eigen::Vector2d on_curve =
          points.front().point_px + coefficients.transpose() * terms[i];
      distances[i] = points[i].normal.dot(points[i].point_px - on_curve);
    }
  }
  return distances;
}

}  // namespace bladecurve
