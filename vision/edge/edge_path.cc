// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_path.h"

#include <algorithm>
#include <cmath>

#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kCurvatureReach = 4;  // px to either side; averages the noise of second differences

std::vector<Vector2d> ResampleEveryPixel(const std::vector<Vector2d>& polyline) {
  double length = 0;
  for (size_t i = 1; i < polyline.size(); ++i) length += (polyline[i] - polyline[i - 1]).norm();
  const int intervals = static_cast<int>(std::lround(length));
  if (intervals < 2) throw Refused(Reason::kEdgeTooShort, "edge: the guessed path has no length");
  std::vector<Vector2d> points{polyline.front()};
  points.reserve(static_cast<size_t>(intervals) + 1);
  const double spacing = length / intervals;
  double passed = 0;
  for (size_t i = 1; i < polyline.size(); ++i) {
    const Vector2d step = polyline[i] - polyline[i - 1];
    const double norm = step.norm();
    while (static_cast<int>(points.size()) < intervals &&
           static_cast<double>(points.size()) * spacing <= passed + norm) {
      const double along = static_cast<double>(points.size()) * spacing - passed;
      points.push_back(polyline[i - 1] + step * (along / norm));
    }
    passed += norm;
  }
  points.push_back(polyline.back());
  return points;
}

// Continues the sequence beyond its ends by point reflection, so that smoothing keeps the ends in
// place.
Vector2d Reflected(const std::vector<Vector2d>& points, int i) {
  const int last = static_cast<int>(points.size()) - 1;
  if (i < 0) return 2 * points.front() - points[static_cast<size_t>(std::min(-i, last))];
  if (i > last) return 2 * points.back() - points[static_cast<size_t>(std::max(2 * last - i, 0))];
  return points[static_cast<size_t>(i)];
}

// Three running means come close to a Gaussian.
std::vector<Vector2d> RunningMeans(std::vector<Vector2d> points, int reach) {
  for (int pass = 0; pass < 3 && reach > 0; ++pass) {
    std::vector<Vector2d> means(points.size());
    Vector2d sum = Vector2d::Zero();
    for (int i = -reach; i <= reach; ++i) sum += Reflected(points, i);
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      means[static_cast<size_t>(i)] = sum / (2 * reach + 1);
      sum += Reflected(points, i + reach + 1) - Reflected(points, i - reach);
    }
    points = std::move(means);
  }
  return points;
}

}  // namespace

EdgePath SmoothPath(const std::vector<Vector2d>& polyline,
                    bool blade_on_left,
                    double smoothing_px) {
  EdgePath path;
  path.blade_on_left = blade_on_left;
  path.points =
      RunningMeans(ResampleEveryPixel(polyline), static_cast<int>(std::lround(smoothing_px)));
  const int n = path.size();
  const double side = blade_on_left ? -1 : 1;  // left of (dx, dy) is (dy, -dx), y down
  for (int i = 0; i < n; ++i) {
    const Vector2d tangent =
        (Reflected(path.points, i + 1) - Reflected(path.points, i - 1)).normalized();
    path.tangents.push_back(tangent);
    path.normals.push_back(side * Vector2d(tangent.y(), -tangent.x()));
  }
  for (int i = 0; i < n; ++i) {
    const int before = std::clamp(i - kCurvatureReach, 0, n - 1);
    const int after = std::clamp(i + kCurvatureReach, 0, n - 1);
    const Vector2d turn =
        path.normals[static_cast<size_t>(after)] - path.normals[static_cast<size_t>(before)];
    const double run =
        (path.points[static_cast<size_t>(after)] - path.points[static_cast<size_t>(before)]).norm();
    path.curvatures.push_back(turn.dot(path.tangents[static_cast<size_t>(i)]) /
                              std::max(run, 1e-9));
  }
  return path;
}

std::vector<Vector2d> Shifted(const EdgePath& path, const std::vector<double>& offsets_px) {
  std::vector<Vector2d> points(path.points);
  for (size_t i = 0; i < points.size(); ++i) points[i] += offsets_px[i] * path.normals[i];
  return points;
}

std::vector<double> SpreadEvenly(const std::vector<double>& values, int count) {
  std::vector<double> spread;
  const auto last = static_cast<size_t>(std::max(count - 1, 1));
  for (size_t i = 0; i < static_cast<size_t>(count); ++i)
    spread.push_back(values[i * (values.size() - 1) / last]);
  return spread;
}

std::vector<double> SmoothValues(const std::vector<double>& values,
                                 const std::vector<double>& weights,
                                 double stiffness) {
  const size_t n = values.size();
  if (n < 3) return values;
  // (W + k D'D) f = W v with D the second difference: symmetric, two bands beside the diagonal;
  // solved as L D L'.
  std::vector<double> diagonal(weights), first(n, 0.0), second(n, 0.0), right(n);
  for (size_t i = 0; i < n; ++i) right[i] = weights[i] * values[i];
  for (size_t i = 0; i + 2 < n; ++i) {
    diagonal[i] += stiffness;
    diagonal[i + 1] += 4 * stiffness;
    diagonal[i + 2] += stiffness;
    first[i] -= 2 * stiffness;
    first[i + 1] -= 2 * stiffness;
    second[i] += stiffness;
  }
  for (size_t i = 0; i < n; ++i) {
    const double a = first[i] / diagonal[i], b = second[i] / diagonal[i];
    if (i + 1 < n) {
      diagonal[i + 1] -= a * first[i];
      first[i + 1] -= a * second[i];
      right[i + 1] -= a * right[i];
    }
    if (i + 2 < n) {
      diagonal[i + 2] -= b * second[i];
      right[i + 2] -= b * right[i];
    }
  }
  std::vector<double> smooth(n);
  for (size_t i = n; i-- > 0;) {
    double rest = right[i];
    if (i + 1 < n) rest -= first[i] * smooth[i + 1];
    if (i + 2 < n) rest -= second[i] * smooth[i + 2];
    smooth[i] = rest / diagonal[i];
  }
  return smooth;
}

}  // namespace bladecurve
