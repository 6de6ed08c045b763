// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/mirror_line.h"

namespace bladecurve {

// Whether one edge may have been lost: they are more unlike than any view makes them, and one is
// clear while the other is not.
[[nodiscard]] bool MayHaveLostOne(const MirrorView& view, const Pivot& pivot, const Blades& blades);

// Blades mirror each other about the line through the pivot. Where the edges do not, and markers
// tell the tilt of the view, each is looked for anew where the other one's mirror image lies; if
// one of them stands out more clearly there than where it was, or alone is seen there, outside of
// where it was, it is taken from there, trimmed, and pivot->asymmetry says how alike the two are
// then. So is a lost one, whether or not the tilt is known, where it is as clear there as the other.
// So is, from a little difference on, a place within the outer one at which a shadow begins that
// accounts for the difference; and both edges from the inner sides of the bands beside them, if
// those mirror each other. Where they do, but one of them is doubtful, that one is looked for, and
// taken if it is less doubtful there. Where neither stands out, the inner one is taken from the
// other one's mirror image, if that lies on a faint step along its whole. Where nobody knows the
// tilt of the view, otherwise only edges far unlike are looked for, inside a shadow or, if they are
// not clear, on a faint step; whatever is moved is ambiguous then. Edges that pass by the pivot as
// those of scissors do stay where they were if they would hardly pass by it elsewhere.
void RelocateUnlikeEdges(const MirrorView& view, Pivot* pivot, Blades* blades);

}  // namespace bladecurve
