// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Where the edges, elsewhere each other's mirror images about the line through the pivot, part
// towards their ends, one of them has gone over to another line: a bevel's inner border that meets
// the edge at the tip, the other blade's edge at the crotch. That end is cut off: of the edge that
// leaves its own course there, of both where either might. Edges of blades that are bent to one
// side part as well, but as parabolas do, from end to end, or over more than a third of what is to
// be cut: they stay, the latter as `edges_part`.
void CutWhereEdgesPart(const BladeView& view, const Pivot& pivot, Blades* blades);

// The same for edges that pass the pivot unlike, of which one is to be doubted or looked for anew:
// where they are alike once such an end is cut off, that end alone was wrong. Sets
// pivot->asymmetry then; leaves all as it is otherwise.
void CutUnlikeEnds(const BladeView& view, Pivot* pivot, Blades* blades);

}  // namespace bladecurve
