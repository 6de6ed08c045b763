// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/pivot/edge_gap.h"
#include "vision/pivot/pivot.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/scale/plane_map.h"
#include "vision/scissors/blade_view.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// The edges of two blades, of which one is the left one.
[[nodiscard]] EdgePair PairOf(const LocatedBlade& a, const LocatedBlade& b);

// How far the blades of a pair are ground alike, of their length.
inline constexpr double kGroundAlike = 0.002;

// The line about which the blades turn into each other, in the plane of the edges.
struct MirrorLine {
  const PlaneMap& map;
  Eigen::Vector2d pivot, direction;

  [[nodiscard]] Eigen::Vector2d Across() const { return {-direction.y(), direction.x()}; }
  // The image of a point of the plane, from the pivot on along the line and aside of it.
  [[nodiscard]] Eigen::Vector2d At(double along, double aside) const;
  [[nodiscard]] Eigen::Vector2d Reflected(const Eigen::Vector2d& image_px) const;
  // A point of one edge as a point of the other.
  [[nodiscard]] LocatedEdgePoint Reflected(LocatedEdgePoint point) const;
  [[nodiscard]] std::vector<LocatedEdgePoint> Reflected(std::vector<LocatedEdgePoint> points) const;
  // The line about which mirror images are turned about the pivot by that, x to y of the plane.
  [[nodiscard]] MirrorLine TurnedBy(double rad) const;
  // The line about which mirror images lie where an edge does that is apart from them by a straight
  // course.
  [[nodiscard]] MirrorLine MovedBy(const GapCourse& apart) const;
};

// Whether edges are to mirror each other about a line through the pivot: markers tell the tilt of
// the view, and the pivot lies not just where the edges do so.
[[nodiscard]] bool KnowsMirror(const BladeView& view, const Pivot& pivot);

// Whether there is a pivot about which edges may be compared although nobody knows the view's tilt:
// edges that agree then tell much, edges that do not tell little.
[[nodiscard]] bool AssumesMirror(const BladeView& view, const Pivot& pivot);

// Through the pivot, halfway between the edges' directions: an edge that lies aside of its place
// runs much as it should. Where the mirror is known.
[[nodiscard]] MirrorLine LineBetween(const BladeView& view,
                                     const Pivot& pivot,
                                     const Blades& blades);

// Through the pivot, halfway between the distal ends: where an edge was lost, not where it runs.
[[nodiscard]] MirrorLine LineBetweenEnds(const BladeView& view,
                                         const Pivot& pivot,
                                         const Blades& blades);

// How far aside of the other's mirror image an edge lies at each distance from the pivot that both
// reach, from there outwards; in the plane of the edges, mm, anticlockwise.
[[nodiscard]] EdgeGap GapFromMirrored(const MirrorLine& line,
                                      const LocatedBlade& blade,
                                      const LocatedBlade& other);

// How far one edge lies from the other's mirror image, turned about the pivot as far as fits them
// best: what all but a fifth of it keeps to, as a share of the blades' length. Where the mirror is
// known. 0 if they have nothing in common to compare.
[[nodiscard]] double ShapeDifference(const BladeView& view,
                                     const Pivot& pivot,
                                     const Blades& blades);

}  // namespace bladecurve
