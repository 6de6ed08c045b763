// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/distal_end.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Offsets of the edge's points from a cubic through its proximal part, over the position along the
// chord.
struct Residuals {
  std::vector<double> along_px;
  std::vector<double> off_px;
};

constexpr double kProximalFrom = 0.08;  // the crotch may still be blurred there
constexpr double kProximalTo = 0.80;    // tips round off in the last fifth at most

Residuals OffsetsFromSmoothEdge(const std::vector<Vector2d>& edge) {
  const Vector2d origin = edge.front();
  const Vector2d along = (edge[edge.size() * 4 / 5] - origin).normalized();
  const Vector2d across(-along.y(), along.x());
  Residuals r;
  for (const Vector2d& p : edge) {
    r.along_px.push_back((p - origin).dot(along));
    r.off_px.push_back((p - origin).dot(across));
  }
  const double length = r.along_px.back();
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const double t = r.along_px[i] / length;
    if (t > kProximalFrom && t < kProximalTo) used.push_back(i);
  }
  const auto row = [&](std::size_t i) {
    const double t = r.along_px[i] / length;
    return Eigen::RowVector4d(1, t, t * t, t * t * t);
  };
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(used.size()), 4);
  Eigen::VectorXd values(static_cast<Eigen::Index>(used.size()));
  for (std::size_t k = 0; k < used.size(); ++k) {
    terms.row(static_cast<Eigen::Index>(k)) = row(used[k]);
    values[static_cast<Eigen::Index>(k)] = r.off_px[used[k]];
  }
  const Eigen::Vector4d c = terms.colPivHouseholderQr().solve(values);
  for (std::size_t i = 0; i < edge.size(); ++i) r.off_px[i] -= row(i) * c;
  return r;
}

// Sum of squares left after the best curvature for a tip that begins at t0, over the points from
// `from` on.
double SquaresLeft(const Residuals& r, std::size_t from, double t0) {
  double wy = 0;
  double ww = 0;
  double yy = 0;
  for (std::size_t i = from; i < r.off_px.size(); ++i) {
    const double d = std::max(0.0, r.along_px[i] - t0);
    const double w = 0.5 * d * d;
    wy += w * r.off_px[i];
    ww += w * w;
    yy += r.off_px[i] * r.off_px[i];
  }
  return ww > 0 ? yy - wy * wy / ww : yy;
}

}  // namespace

DistalEnd FindDistalEnd(const std::vector<Vector2d>& edge, double sigma_px) {
  constexpr std::size_t kFewest = 12;
  if (edge.size() < kFewest) {
    const double length = edge.size() < 2 ? 1 : (edge.back() - edge.front()).norm();
    return {edge.empty() ? Vector2d::Zero() : edge.back(), edge.size(), length};
  }
  const Residuals r = OffsetsFromSmoothEdge(edge);
  const double length = r.along_px.back();
  const std::size_t from = edge.size() * 3 / 5;
  constexpr double kStep = 0.25;  // px
  const double first = 0.75 * length;
  double best_t = length;
  double best = SquaresLeft(r, from, length);
  std::vector<double> squares;
  for (double t = first; t < length; t += kStep) {
    squares.push_back(SquaresLeft(r, from, t));
    if (squares.back() < best) {
      best = squares.back();
      best_t = t;
    }
  }
  // Places that explain the points about as well: within chi-square 1 of correlated points.
  const double scatter =
      std::max(sigma_px, std::sqrt(best / static_cast<double>(edge.size() - from)));
  constexpr double kCorrelatedPoints = 4;
  double low = best_t;
  double high = best_t;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    if (squares[k] > best + kCorrelatedPoints * scatter * scatter) continue;
    low = std::min(low, first + static_cast<double>(k) * kStep);
    high = std::max(high, first + static_cast<double>(k) * kStep);
  }
  DistalEnd end;
  const auto after =
      std::find_if(r.along_px.begin(), r.along_px.end(), [&](double t) { return t > best_t; });
  end.index = static_cast<std::size_t>(after - r.along_px.begin());
  end.point_px = edge[std::min(end.index, edge.size() - 1)];
  end.along_sigma_px = std::max(0.5, 0.5 * (high - low));
  return end;
}

}  // namespace bladecurve
