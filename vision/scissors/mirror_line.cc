// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/mirror_line.h"

#include <cmath>
#include <vector>

#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {

using Eigen::Vector2d;

EdgePair PairOf(const LocatedBlade& a, const LocatedBlade& b) {
  return a.on_left ? EdgePair{PointsOf(a), PointsOf(b)} : EdgePair{PointsOf(b), PointsOf(a)};
}

Vector2d MirrorLine::At(double along, double aside) const {
  return map.ImageFromPlane(pivot + along * direction + aside * Across());
}

Vector2d MirrorLine::Reflected(const Vector2d& image_px) const {
  const Vector2d offset = map.PlaneFromImage(image_px) - pivot;
  return map.ImageFromPlane(pivot + 2 * offset.dot(direction) * direction - offset);
}

LocatedEdgePoint MirrorLine::Reflected(LocatedEdgePoint point) const {
  const Vector2d outside_px = Reflected(Vector2d(point.trend_px + point.normal));
  point.point_px = Reflected(point.point_px);
  point.trend_px = Reflected(point.trend_px);
  point.normal = (outside_px - point.trend_px).normalized();
  return point;
}

bool KnowsMirror(const BladeView& view, const Pivot& pivot) {
  return view.scale().sheet && AssumesMirror(view, pivot);
}

bool AssumesMirror(const BladeView& view, const Pivot& pivot) {
  return view.scale().map && pivot.source != "geometry";
}

MirrorLine LineBetween(const BladeView& view, const Pivot& pivot, const Blades& blades) {
  const PlaneMap& map = *view.scale().map;
  const auto direction = [&](const LocatedBlade& blade) {
    return (map.PlaneFromImage(blade.used.back().trend_px) -
            map.PlaneFromImage(blade.used.front().trend_px))
        .normalized();
  };
  return {map,
          map.PlaneFromImage(pivot.point_px),
          (direction(blades.upper) + direction(blades.lower)).normalized()};
}

MirrorLine LineBetweenEnds(const BladeView& view, const Pivot& pivot, const Blades& blades) {
  const PlaneMap& map = *view.scale().map;
  const Vector2d origin = map.PlaneFromImage(pivot.point_px);
  const auto direction = [&](const LocatedBlade& blade) {
    return (map.PlaneFromImage(blade.end.point_px) - origin).normalized();
  };
  return {map, origin, (direction(blades.upper) + direction(blades.lower)).normalized()};
}

double ShapeDifference(const BladeView& view, const Pivot& pivot, const Blades& blades) {
  constexpr double kMostOfIt = 0.8;
  const MirrorLine line = LineBetween(view, pivot, blades);
  std::vector<Vector2d> mirrored;  // from the pivot, ever further
  for (const LocatedEdgePoint& p : blades.lower.used)
    mirrored.push_back(line.Reflected(p.trend_px) - pivot.point_px);
  std::vector<double> radius, aside, turn;
  std::size_t next = 0;
  for (const LocatedEdgePoint& p : blades.upper.used) {
    const Vector2d ray = p.trend_px - pivot.point_px;
    while (next < mirrored.size() && mirrored[next].norm() < ray.norm()) ++next;
    if (next == 0 || next == mirrored.size()) continue;
    radius.push_back(ray.norm());
    aside.push_back(Cross(ray, mirrored[next]) / ray.norm());
    turn.push_back(aside.back() / radius.back());
  }
  if (radius.empty()) return 0;
  const double best_turn = Median(turn);
  for (std::size_t i = 0; i < aside.size(); ++i)
    aside[i] = std::abs(aside[i] - best_turn * radius[i]);
  return SampleQuantile(aside, kMostOfIt) / radius.back();
}

}  // namespace bladecurve
