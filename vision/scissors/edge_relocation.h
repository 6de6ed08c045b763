// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Whether one edge may have been lost: they are more unlike than any view makes them, and one is
// clear while the other is not.
[[nodiscard]] bool MayHaveLostOne(const BladeView& view, const Pivot& pivot, const Blades& blades);

// Blades mirror each other about the line through the pivot, unless both are bent to one side.
// Where the edges do not, one of them is looked for anew, trimmed, and pivot->asymmetry says how
// alike the two are then:
// - one that was never located, where a clear one's mirror image, turned about the pivot, falls
//   on a line along all of it, if it is seen there and the two pass the pivot alike;
// - a lost one, where the other puts it, if it is as clear there as the other;
// - of edges in a view of known tilt (markers), from a little difference on, the outer one further
//   in, where a shadow begins that accounts for the difference;
// - both, at the inner sides of the bands beside them, if those mirror each other;
// - the one that stands out more clearly where the other puts it, or alone is seen there, further
//   out than it was, and not less surely if the pivot may account for the difference, but no clear
//   one where a doubtful one puts it; if neither does, the inner one along the other's mirror
//   image, if they differ by more than the pivot may be off and that lies on a faint border along
//   its whole, or else, however clear it is, where the blade's colour ends or along its rival
//   further out, no further than bevels are wide, if there it mirrors the other by far better; if
//   neither helps, the vaguer one is doubted by as much as they differ;
// - of edges that pass the pivot alike but are unlike in shape, or of which one is doubtful and
//   has a rival, that one, if it is seen where the other puts it;
// - one that is doubtful or kinked, if nothing else helps, along the other's mirror image, if that
//   is clear and most of it lies on that; whoever knows the tilt.
// None is moved to beyond the part of its blade that faces the gap.
// Where nobody knows the tilt edges far unlike are looked for inside a shadow or, if they are not
// clear, on a faint border, the upper one only if it has a rival; one that has a rival is taken
// where the other puts it, if it alone is seen there, and far better, and not far in; or the inner
// one further out as above, if it is not far vaguer. Whatever is moved is ambiguous then, and less
// certain where a slant may have parted them. Edges that pass by the pivot as those of scissors do
// stay where they were if they would hardly pass by it elsewhere.
void RelocateUnlikeEdges(const BladeView& view, Pivot* pivot, Blades* blades);

// Once ends at which the edges part are cut off, those that mirrored each other with them may not
// without: an edge that was moved is doubted by as much as they pass the pivot unlike, if that is
// more than the pivot may be off. In a view of known tilt.
void DoubtMovedEdges(const BladeView& view, const Pivot& pivot, Blades* blades);

}  // namespace bladecurve
