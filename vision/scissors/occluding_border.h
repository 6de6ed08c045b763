// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge.h"
#include "vision/scissors/blade_view.h"

namespace bladecurve {

// What becomes of the other blade's edge, coming in from its tip, in the band between the border of
// a blade and a line on it.
enum class Occlusion {
  kUntold,  // it does not show well enough
  kNone,    // it is seen in the band, but not on the blade: that is ground, or a shadow on it
  kOnTop,   // it is seen in the band and on the blade: no bevel, its own blade is the top one
  kHidden,  // it ends at the border, in a T-junction: the band is the top blade's bevel
};

// Whether the edge is seen in the band, be it on the blade or not.
[[nodiscard]] constexpr bool IsSeenInBand(Occlusion occlusion) {
  return occlusion == Occlusion::kNone || occlusion == Occlusion::kOnTop;
}

// All from the crotch on: `border` further out than the line `inner`; `other`, the other blade's
// edge. Told to be hidden only where the band is brighter than the ground, as a shadow may hide an
// edge, too, and the edge is not seen on the blade.
[[nodiscard]] Occlusion OcclusionUpTo(const BladeView& view,
                                      const std::vector<LocatedEdgePoint>& border,
                                      const std::vector<LocatedEdgePoint>& inner,
                                      const std::vector<LocatedEdgePoint>& other);

// The same in the band between an edge and the line `line_px` out of it, or within.
[[nodiscard]] Occlusion OcclusionBeside(const BladeView& view,
                                        const LocatedEdge& edge,
                                        double line_px,
                                        const LocatedEdge& other);

// An edge that has a rival is in no doubt for that if the other blade's edge tells the band between
// the two: seen in it, that is no metal; hidden, it is.
void ConfirmByOcclusion(const BladeView& view, const LocatedEdge& other, LocatedEdge* edge);

}  // namespace bladecurve
