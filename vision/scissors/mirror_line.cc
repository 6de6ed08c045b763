// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/mirror_line.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {

using Eigen::Vector2d;

EdgePair PairOf(const LocatedBlade& a, const LocatedBlade& b) {
  const bool traced = a.edge.traced || b.edge.traced;
  return a.on_left ? EdgePair{PointsOf(a), PointsOf(b), traced}
                   : EdgePair{PointsOf(b), PointsOf(a), traced};
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

std::vector<LocatedEdgePoint> MirrorLine::Reflected(std::vector<LocatedEdgePoint> points) const {
  for (LocatedEdgePoint& p : points) p = Reflected(p);
  return points;
}

MirrorLine MirrorLine::TurnedBy(double rad) const {
  return {map, pivot, Eigen::Rotation2Dd(0.5 * rad) * direction};
}

MirrorLine MirrorLine::MovedBy(const GapCourse& apart) const {
  const double aside = apart.powers[0], turn = apart.powers[1];
  return {map, pivot + 0.5 * aside * Across(), TurnedBy(turn).direction};
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

EdgeGap GapFromMirrored(const MirrorLine& line,
                        const LocatedBlade& blade,
                        const LocatedBlade& other) {
  const auto from_pivot = [&](const Vector2d& image_px) -> Vector2d {
    return line.map.PlaneFromImage(image_px) - line.pivot;
  };
  std::vector<Vector2d> mirrored;  // ever further
  for (const LocatedEdgePoint& p : other.used)
    mirrored.push_back(from_pivot(line.Reflected(p.trend_px)));
  EdgeGap gap;
  std::size_t next = 0;
  for (const LocatedEdgePoint& p : blade.used) {
    const Vector2d ray = from_pivot(p.trend_px);
    const double radius = ray.norm();
    while (next < mirrored.size() && mirrored[next].norm() < radius) ++next;
    if (next == 0 || next == mirrored.size()) continue;
    gap.along.push_back(radius);
    gap.apart.push_back(Cross(mirrored[next], ray) / radius);
  }
  return gap;
}

double ShapeDifference(const BladeView& view, const Pivot& pivot, const Blades& blades) {
  constexpr double kMostOfIt = 0.8;
  const EdgeGap gap = GapFromMirrored(LineBetween(view, pivot, blades), blades.upper, blades.lower);
  if (gap.along.empty()) return 0;
  std::vector<double> turns, asides;
  for (std::size_t i = 0; i < gap.along.size(); ++i) turns.push_back(gap.apart[i] / gap.along[i]);
  const double best_turn = Median(std::move(turns));
  for (std::size_t i = 0; i < gap.along.size(); ++i)
    asides.push_back(std::abs(gap.apart[i] - best_turn * gap.along[i]));
  return SampleQuantile(asides, kMostOfIt) / gap.along.back();
}

}  // namespace bladecurve
