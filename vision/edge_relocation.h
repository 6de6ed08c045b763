// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/mirror_line.h"
#include "vision/pivot_geometry.h"

namespace bladecurve {

// Blades mirror each other about the line through the pivot. Where the edges do not, and markers
// tell the tilt of the view, each is looked for anew where the other one's mirror image lies; if
// one of them stands out more clearly there than where it was, or alone is seen there, outside of
// where it was, it is taken from there, trimmed, and pivot->asymmetry says how alike the two are
// then. Where they do, but one of them is doubtful, that one is looked for, and taken if it is less
// doubtful there.
void RelocateUnlikeEdges(const MirrorView& view, Pivot* pivot, Blades* blades);

// The edges of two blades, of which one is the left one.
[[nodiscard]] EdgePair PairOf(const LocatedBlade& a, const LocatedBlade& b);

// Whether an edge is in no doubt by itself: no other border beside it, and known to a pixel.
[[nodiscard]] bool IsClear(const LocatedEdge& edge);

}  // namespace bladecurve
