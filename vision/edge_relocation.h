// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/mirror_line.h"

namespace bladecurve {

// Blades mirror each other about the line through the pivot. Where the edges do not, and markers
// tell the tilt of the view, each is looked for anew where the other one's mirror image lies; if
// one of them stands out more clearly there than where it was, or alone is seen there, outside of
// where it was, it is taken from there, trimmed, and pivot->asymmetry says how alike the two are
// then. So is, from a little difference on, a place within the outer one at which a shadow begins
// that accounts for the difference. Where they do, but one of them is doubtful, that one is looked
// for, and taken if it is less doubtful there. Where neither stands out, the inner one is taken
// from the other one's mirror image, if that lies on a faint step along its whole. Where nobody
// knows the tilt of the view, only edges far unlike are looked for, inside a shadow or on a faint
// step, and are ambiguous then.
void RelocateUnlikeEdges(const MirrorView& view, Pivot* pivot, Blades* blades);

}  // namespace bladecurve
