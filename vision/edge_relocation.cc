// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_relocation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/consistency.h"
#include "vision/edge_pair.h"
#include "vision/pivot_geometry.h"
#include "vision/plane_map.h"
#include "vision/refused.h"
#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The line about which the blades turn into each other, in the plane of the edges.
struct MirrorLine {
  const PlaneMap& map;
  Vector2d pivot, direction;

  [[nodiscard]] Vector2d Reflected(const Vector2d& image_px) const {
    const Vector2d offset = map.PlaneFromImage(image_px) - pivot;
    return map.ImageFromPlane(pivot + 2 * offset.dot(direction) * direction - offset);
  }
};

// Halfway between the edges' directions: an edge that lies aside of its place runs much as it
// should.
MirrorLine LineBetween(const PlaneMap& map, const Pivot& pivot, const Blades& blades) {
  const auto direction = [&](const LocatedBlade& blade) {
    return (map.PlaneFromImage(blade.used.back().trend_px) -
            map.PlaneFromImage(blade.used.front().trend_px))
        .normalized();
  };
  return {map,
          map.PlaneFromImage(pivot.point_px),
          (direction(blades.upper) + direction(blades.lower)).normalized()};
}

double Contrast(const LocatedEdge& edge) {
  std::vector<double> contrasts;
  for (const LocatedEdgePoint& p : edge.points) {
    if (p.inlier) contrasts.push_back(std::abs(p.contrast));
  }
  return contrasts.empty() ? 0 : Median(std::move(contrasts));
}

EdgePair PairOf(const LocatedBlade& a, const LocatedBlade& b) {
  return a.on_left ? EdgePair{PointsOf(a), PointsOf(b)} : EdgePair{PointsOf(b), PointsOf(a)};
}

// A blade located anew.
struct Relocated {
  LocatedBlade blade;
  double asymmetry = 0;
};

// `blade` where `other` puts it, if it is seen there and the two are alike then.
std::optional<Relocated> LookWhereMirrored(const RelocationView& view,
                                           const MirrorLine& line,
                                           const Pivot& pivot,
                                           const LocatedBlade& blade,
                                           const LocatedBlade& other) {
  constexpr double kNearest = 5, kOfWay = 0.35;  // px; of the way that the edge would move
  constexpr double kClear = 0.5;                 // ambiguity
  EdgeGuess guess;
  for (const LocatedEdgePoint& p : other.edge.points) {
    if (p.inlier) guess.path_px.push_back(line.Reflected(p.trend_px));
  }
  guess.blade_on_left = blade.on_left;
  const double length_px = (other.end.point_px - pivot.point_px).norm();
  guess.search_px = std::max(kNearest, kOfWay * std::abs(pivot.asymmetry) * length_px);
  Relocated found;
  found.blade.on_left = blade.on_left;
  try {
    found.blade.edge = LocateBladeAlong(view.photo, view.scale, guess);
    TrimToFree(view.photo, view.scene, &found.blade);
  } catch (const Refused&) {
    return std::nullopt;
  }
  found.asymmetry = EdgeAsymmetry(PairOf(found.blade, other), pivot.point_px);
  if (found.blade.edge.ambiguity > kClear || !AreAlike(found.asymmetry)) return std::nullopt;
  return found;
}

}  // namespace

void RelocateUnlikeEdges(const RelocationView& view, Pivot* pivot, Blades* blades) {
  if (pivot->source == "geometry" || !view.scale.sheet || !AreUnlike(pivot->asymmetry)) return;
  const MirrorLine line = LineBetween(*view.scale.map, *pivot, *blades);
  std::optional<Relocated> upper =
      LookWhereMirrored(view, line, *pivot, blades->upper, blades->lower);
  std::optional<Relocated> lower =
      LookWhereMirrored(view, line, *pivot, blades->lower, blades->upper);
  const auto clearer = [](const std::optional<Relocated>& found, const LocatedBlade& before) {
    return found && Contrast(found->blade.edge) > Contrast(before.edge);
  };
  const bool upper_clearer = clearer(upper, blades->upper);
  if (upper_clearer == clearer(lower, blades->lower)) return;  // either, or neither
  Relocated& found = upper_clearer ? *upper : *lower;
  (upper_clearer ? blades->upper : blades->lower) = std::move(found.blade);
  pivot->asymmetry = found.asymmetry;
}

}  // namespace bladecurve
