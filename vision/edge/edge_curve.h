// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vision/edge/edge.h"

namespace bladecurve {

// The low-order curve that most of the points follow, abreast of each of them. A cutting edge is
// such a curve from crotch to distal end; what leaves it at the ends is the other blade or the
// rounding of the tip.
[[nodiscard]] std::vector<Eigen::Vector2d> PlainCurve(const std::vector<LocatedEdgePoint>& points);

// Distance of each point from it, along the point's normal.
[[nodiscard]] std::vector<double> DistancesFromPlainCurve(
    const std::vector<LocatedEdgePoint>& points);

// How far the points' trends are off it: what that share of them keeps to. px
[[nodiscard]] double OffPlainCurve(const std::vector<LocatedEdgePoint>& points, double share);

// Marks as strays the few points beyond a wider gap, towards either end, that do not go on as the
// curve of the rest would: near the tip, where a bevel mirrors the ground, the line found may go
// over to the bevel's inner border. Returns whether there were any.
bool RejectDetachedEnds(std::vector<LocatedEdgePoint>& points);

// Indices of the first and the last point, both inside.
struct PointRange {
  std::size_t first = 0, last = 0;
};

// Median distance of the inlying points of `run` from the cubic that those of `stretch` follow,
// continued. px.
[[nodiscard]] double LeavesCourseBy(const std::vector<LocatedEdgePoint>& points,
                                    const PointRange& stretch,
                                    const PointRange& run);

// A place on an edge's course, and its standard uncertainty across the edge.
struct PlaceOnCourse {
  Eigen::Vector2d point_px;
  double across_sigma_px = 0;
};

struct CourseDoubt {
  double correlation_px = 0;  // errors of points nearer to each other go together
  double smeared_px = 0;      // so near to the place, the tip may have bent the edge
};

// The point abreast of `place_px`, at or a little beyond the distal end of an edge, on the cubic
// that its inlying points follow over the distal three fifths up to there; as uncertain, too, as
// the points that the tip cannot have bent would put it elsewhere. Where the points end far before,
// the place itself, which is as often off as the cubic, and as uncertain as they differ.
// std::nullopt for fewer than 20 such points.
[[nodiscard]] std::optional<PlaceOnCourse> AbreastOnCourse(
    const std::vector<LocatedEdgePoint>& points,
    const CourseDoubt& doubt,
    const Eigen::Vector2d& place_px);

}  // namespace bladecurve
