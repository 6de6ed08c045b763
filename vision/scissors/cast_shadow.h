// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/blade_view.h"

namespace bladecurve {

// An edge across which light rises so slowly, going outwards, that it is vague although print
// bounds its blur, with no second line near, is a soft shadow's border: from there to where the
// shadow begins, if that is seen.
[[nodiscard]] LocatedEdge LeaveSoftShadow(const BladeView& view, LocatedEdge edge, bool left);

// An edge along the border of a shadow that its blade casts is looked for where that begins. The
// other blade's edge goes on within it, but not over its blade; or, in some doubt, its own shank or
// the other blade's outer side, which face the same way, cast the same one.
void LeaveCastShadow(const BladeView& view, BladeEdges* edges);

// An edge of dark metal along the border of its own shadow, where that is so narrow that it looks
// like blur: moved to where the shadow begins. The other blade's outer side or the own shank, which
// face about the same way, cast one, too, and the blade's outer side, which faces the other way,
// none. In doubt by some of the width.
void LeaveNarrowShadow(const BladeView& view, BladeEdges* edges);

// A dark line along an edge, so narrow that nothing tells whether it is a bevel or the shadow where
// the blade all but touches what it lies on: the edge may lie on its other side.
void DoubtDarkLine(const BladeView& view, bool left, LocatedEdge* edge);

}  // namespace bladecurve
