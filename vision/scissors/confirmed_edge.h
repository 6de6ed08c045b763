// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Where markers tell the view and the pivot is seen, edges that mirror each other about it confirm
// each other: one beside which another transition might have been the border is no longer doubted
// for that if the edges would be unlike with it, whatever the other edge's border is. Not edges
// that were moved to where they mirror each other.
void ConfirmMirroredEdges(const BladeView& view, const Pivot& pivot, Blades* blades);

}  // namespace bladecurve
