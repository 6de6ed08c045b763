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
  return AreAlike(found.asymmetry) ? std::optional(std::move(found)) : std::nullopt;
}

constexpr double kClear = 0.5;  // ambiguity
constexpr double kVague = 1;    // px of common uncertainty

bool IsClear(const LocatedEdge& edge) {
  return edge.ambiguity <= kClear && edge.common_sigma_px <= kVague;
}

bool IsDoubtful(const LocatedEdge& edge) {
  constexpr double kDoubt = 0.75;  // ambiguity
  return edge.ambiguity > kDoubt || edge.common_sigma_px > kVague;
}

void Replace(Relocated&& found, LocatedBlade* blade, Pivot* pivot) {
  *blade = std::move(found.blade);
  pivot->asymmetry = found.asymmetry;
}

// Edges that do not mirror each other: the one that stands out more clearly where the other puts
// it.
void RelocateClearerOne(const RelocationView& view, Pivot* pivot, Blades* blades) {
  const MirrorLine line = LineBetween(*view.scale.map, *pivot, *blades);
  const auto look = [&](const LocatedBlade& blade, const LocatedBlade& other) {
    std::optional<Relocated> found = LookWhereMirrored(view, line, *pivot, blade, other);
    if (found && found->blade.edge.ambiguity > kClear) found.reset();
    return found;
  };
  std::optional<Relocated> upper = look(blades->upper, blades->lower);
  std::optional<Relocated> lower = look(blades->lower, blades->upper);
  const auto clearer = [](const std::optional<Relocated>& found, const LocatedBlade& before) {
    return found && Contrast(found->blade.edge) > Contrast(before.edge);
  };
  const bool upper_clearer = clearer(upper, blades->upper);
  if (upper_clearer == clearer(lower, blades->lower)) return;  // either, or neither
  if (upper_clearer) {
    Replace(*std::move(upper), &blades->upper, pivot);
  } else {
    Replace(*std::move(lower), &blades->lower, pivot);
  }
}

// A doubtful edge, where the other one, if clear, puts it, if that leaves less doubt.
void RelocateDoubtfulOne(const RelocationView& view, Pivot* pivot, Blades* blades) {
  constexpr double kLess = 0.75;  // of the ambiguity before
  const bool is_upper = IsDoubtful(blades->upper.edge);
  LocatedBlade& doubtful = is_upper ? blades->upper : blades->lower;
  const LocatedBlade& other = is_upper ? blades->lower : blades->upper;
  if (!IsDoubtful(doubtful.edge) || !IsClear(other.edge)) return;
  const MirrorLine line = LineBetween(*view.scale.map, *pivot, *blades);
  std::optional<Relocated> found = LookWhereMirrored(view, line, *pivot, doubtful, other);
  if (!found) return;
  const LocatedEdge &before = doubtful.edge, &after = found->blade.edge;
  if (after.ambiguity < kLess * before.ambiguity && after.common_sigma_px <= before.common_sigma_px)
    Replace(*std::move(found), &doubtful, pivot);
}

}  // namespace

void RelocateUnlikeEdges(const RelocationView& view, Pivot* pivot, Blades* blades) {
  if (pivot->source == "geometry" || !view.scale.sheet) return;
  if (AreUnlike(pivot->asymmetry)) {
    RelocateClearerOne(view, pivot, blades);
  } else {
    RelocateDoubtfulOne(view, pivot, blades);
  }
}

}  // namespace bladecurve
