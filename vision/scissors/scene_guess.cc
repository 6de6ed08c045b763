// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/scene_guess.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

EdgeGuess GuessAlong(const Scene& scene,
                     bool left,
                     std::vector<Vector2d> path_px,
                     bool blade_on_left) {
  constexpr double kNearest = 5;     // px
  constexpr double kFarthest = 0.3;  // of the blade's width: shadow or bevel led the trace astray
  const double width_px = BladeOf(scene, left).width_px;
  return {std::move(path_px),
          blade_on_left,
          std::max(kNearest, 1.5 * scene.path_sigma_px + kFarthest * width_px)};
}

}  // namespace

EdgeGuess CuttingEdgeOf(const Scene& scene, bool left) {
  return GuessAlong(scene, left, BladeOf(scene, left).inner_px, left);
}

EdgeGuess OuterSideOf(const Scene& scene, bool left) {
  constexpr double kFirst = 0.25, kLast = 0.85;  // of the side
  const std::vector<Vector2d>& side = BladeOf(scene, left).outer_px;
  const auto at = [&](double share) {
    return side.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(side.size()));
  };
  return GuessAlong(scene, left, {at(kFirst), at(kLast)}, !left);
}

EdgeGuess ShankSideOf(const Scene& scene, bool left) {
  return GuessAlong(scene, left, BladeOf(scene, left).shank_px, !left);  // from the joint on
}

LocatedEdge AsTraced(const Scene& scene, bool left) {
  LocatedEdge edge;
  const std::vector<Vector2d>& path = BladeOf(scene, left).inner_px;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector2d along =
        (path[std::min(i + 3, path.size() - 1)] - path[i < 3 ? 0 : i - 3]).normalized();
    LocatedEdgePoint point;
    point.point_px = path[i];
    point.trend_px = path[i];
    point.normal = (left ? -1.0 : 1.0) * Vector2d(along.y(), -along.x());
    point.sigma_px = 2 * scene.path_sigma_px;
    edge.points.push_back(point);
  }
  edge.correlation_px = 10 * scene.path_sigma_px;
  edge.common_sigma_px = 2 * scene.path_sigma_px;
  edge.ambiguity = 1;
  edge.traced = true;
  return edge;
}

}  // namespace bladecurve
