// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/lost_end.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "vision/refused.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirror_line.h"
#include "vision/scissors/tip_arc.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Of an edge's points, those beyond the last one that counts.
double LostShare(const LocatedEdge& edge) {
  const auto last = std::find_if(
      edge.points.rbegin(), edge.points.rend(), [](const auto& point) { return point.inlier; });
  return static_cast<double>(std::distance(edge.points.rbegin(), last)) /
         static_cast<double>(edge.points.size());
}

// The line about which the proximal parts of the edges mirror each other, from where they cross.
MirrorLine LineBetweenEdges(const PlaneMap& map, const Blades& blades) {
  EdgePair edges = PairOf(blades.upper, blades.lower);
  for (auto* edge : {&edges.left_px, &edges.right_px})
    for (Vector2d& p : *edge) p = map.PlaneFromImage(p);
  const EdgeMirror mirror = MirrorOf(edges);
  return {map, mirror.point_px, mirror.direction};
}

// The edge as it is seen, and beyond as the other one has it. std::nullopt where too little of them
// lies abreast to tell how that goes on.
std::optional<EdgeGuess> GuessBeyond(const LocatedBlade& blade,
                                     const LocatedBlade& other,
                                     const MirrorLine& line) {
  constexpr double kSearchPx = 3;
  const EdgeGap gap = GapFromMirrored(line, blade, other);
  if (gap.along.size() < kFewestEdgePoints) return std::nullopt;
  GapCourse course;
  course.Fit(gap, 2, [](std::size_t) { return true; });
  const MirrorLine moved = line.MovedBy(course);
  const auto radius = [&](const Vector2d& image_px) {
    return (line.map.PlaneFromImage(image_px) - line.pivot).norm();
  };
  EdgeGuess guess{{}, blade.on_left, kSearchPx};
  for (const LocatedEdgePoint& p : blade.used) guess.path_px.push_back(p.trend_px);
  const double seen_to = radius(guess.path_px.back());
  for (const LocatedEdgePoint& p : other.edge.points) {
    const Vector2d place_px = moved.Reflected(p.trend_px);
    if (p.inlier && radius(place_px) > seen_to) guess.path_px.push_back(place_px);
  }
  return guess;
}

void FindLostEnd(const BladeView& view,
                 const LocatedBlade& other,
                 const MirrorLine& line,
                 LocatedBlade* blade) {
  constexpr double kLost = 0.08, kHardlyLost = 0.1;  // of the points; a tip alone smears fewer
  constexpr double kLess = 0.5;                      // of what was lost before
  constexpr double kNoVaguer = 0.3;                  // of what was known; ends are seen less well
  const double lost = LostShare(blade->edge);
  if (lost < kLost || LostShare(other.edge) > kHardlyLost || IsDoubtful(other.edge)) return;
  const auto guess = GuessBeyond(*blade, other, line);
  if (!guess) return;
  auto found = UnlessRefused([&] {
    LocatedBlade again{blade->on_left, view.InGreyOrAnyColours(*guess), {}, {}, {}};
    TrimToFree(view, &again);
    return again;
  });
  const bool is_whole = found && IsClear(found->edge) && LostShare(found->edge) < kLess * lost &&
                        Information(found->edge) > kNoVaguer * Information(blade->edge);
  if (!is_whole) return;
  KeepRival(blade->edge, &found->edge);
  *blade = *std::move(found);
}

}  // namespace

void FindLostEnds(const BladeView& view, Blades* blades) {
  const PlaneMap map = view.scale().map.value_or(PlaneMap::Uniform(1, 0, kPixelsSource));
  const MirrorLine line = LineBetweenEdges(map, *blades);
  for (const bool upper : {true, false}) {
    const auto [blade, other] = OneOf(blades, upper);
    FindLostEnd(view, other, line, &blade);
  }
}

}  // namespace bladecurve
