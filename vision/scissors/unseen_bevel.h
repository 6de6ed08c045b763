// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/blade_view.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// Lens and compression spread the light of both blades alike. Where it trails off further beyond
// one edge than beyond the other, that is the line of a bevel that mirrors the dark ground: the
// edge is looked for where the trail has it, as sharp as the other.
void LeaveBevelsLine(const BladeView& view, BladeEdges* edges);

// Where it trails off further all the same, the edge becomes ambiguous, and less certain by 1.2
// times as much as it trails further.
void DoubtUnseenBevel(const BladeView& view, Blades* blades);

}  // namespace bladecurve
