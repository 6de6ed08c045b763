// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/lost_end.h"

#include <cstddef>
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

// Of an edge's points.
double LostShare(const LocatedEdge& edge) {
  return static_cast<double>(LostPoints(edge)) / static_cast<double>(edge.points.size());
}

// A tip alone smears fewer.
bool IsLost(const LocatedEdge& edge) {
  constexpr double kLost = 0.08;
  return LostShare(edge) >= kLost;
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

// Ends a blade at the arc of a tip that is certain where it is not seen to end itself.
void EndWhereTipIsSeen(const DistalEnd& tip, LocatedBlade* blade) {
  if (!tip.certain || blade->end.arc_seen) return;
  const Vector2d along = (blade->used.back().point_px - blade->used.front().point_px).normalized();
  blade->end = tip;
  blade->end.index = InliersBefore(blade->edge, tip.point_px, along);
}

void FindLostEnd(const BladeView& view,
                 const LocatedBlade& other,
                 const MirrorLine& line,
                 LocatedBlade* blade) {
  constexpr double kHardlyLost = 0.1;  // of the points
  constexpr double kLess = 0.5;        // of what was lost before
  constexpr double kNoVaguer = 0.3;    // of what was known; ends are seen less well
  if (!IsLost(blade->edge) || LostShare(other.edge) > kHardlyLost || IsDoubtful(other.edge)) return;
  const auto guess = GuessBeyond(*blade, other, line);
  if (!guess) return;
  auto found = UnlessRefused([&] {
    LocatedBlade again{blade->on_left, view.InGreyOrAnyColours(*guess), {}, {}, {}};
    TrimToFree(view, &again);
    return again;
  });
  const bool is_whole = found && IsClear(found->edge) &&
                        LostShare(found->edge) < kLess * LostShare(blade->edge) &&
                        Information(found->edge) > kNoVaguer * Information(blade->edge);
  if (!is_whole) {
    if (found) EndWhereTipIsSeen(found->end, blade);
    return;
  }
  KeepRival(blade->edge, &found->edge);
  *blade = *std::move(found);
}

}  // namespace

void FindLostEnds(const BladeView& view, Blades* blades) {
  if (!IsLost(blades->upper.edge) && !IsLost(blades->lower.edge)) return;
  const PlaneMap map = view.scale().map.value_or(PlaneMap::Uniform(1, 0, kPixelsSource));
  const MirrorLine line = LineBetweenEdges(map, *blades);
  for (const bool upper : {true, false}) {
    const auto [blade, other] = OneOf(blades, upper);
    FindLostEnd(view, other, line, &blade);
  }
}

}  // namespace bladecurve
