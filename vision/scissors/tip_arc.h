// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace bladecurve {

// Fewer points say nothing about where an edge goes on.
inline constexpr std::size_t kFewestEdgePoints = 12;

// Direction of an edge from the crotch towards the tip, its last fifth left out, as that may round
// off.
[[nodiscard]] Eigen::Vector2d AlongChord(const std::vector<Eigen::Vector2d>& edge);

// The cutting edge, continued over the tip: positions along its chord, offsets into the blade, px.
struct EdgeAxis {
  Eigen::Vector2d origin, along, inwards;
  Eigen::Vector4d cubic;  // offset of the edge over the share of its length
  double length = 0;

  // A cubic through the part of the edge that is clear of the crotch and of the tip.
  EdgeAxis(const std::vector<Eigen::Vector2d>& edge,
           const Eigen::Vector2d& tip_px,
           bool blade_on_left);

  [[nodiscard]] double EdgeOffset(double position) const {
    const double s = position / length;
    return cubic[0] + s * (cubic[1] + s * (cubic[2] + s * cubic[3]));
  }
  // The point at a position, `depth` px inside the blade.
  [[nodiscard]] Eigen::Vector2d At(double position, double depth) const {
    return origin + position * along + (EdgeOffset(position) + depth) * inwards;
  }
  [[nodiscard]] double PositionOf(const Eigen::Vector2d& place_px) const;
};

// A place at which something ends on a line parallel to the edge, px, and by how much light steps
// there towards the tip, grey values.
struct EndSeen {
  double depth = 0, position = 0;
  double step = 0;
};

// An arc that leaves the edge tangentially at `start`, a position. px.
struct TipArc {
  double start = 0, radius = 0;
  double score = 0;  // lines explained less lines contradicted, less what the edge denies
  double scatter = 0;
  int seen = 0;     // lines that end on it
  double step = 0;  // typical

  [[nodiscard]] bool Explains(const EndSeen& end) const;
};

// The arc of at most so large a radius, px, that explains most of the ends seen. `followed`: the
// edge's points, which deny an arc where they go on straight. seen is 0 where none explains enough.
[[nodiscard]] TipArc FitTipArc(const std::vector<EndSeen>& ends,
                               const std::vector<EndSeen>& followed,
                               double largest_radius);

}  // namespace bladecurve
