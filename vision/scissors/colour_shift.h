// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/located_blade.h"
#include "vision/stage_log.h"

namespace bladecurve {

// Edges that were located in grey are moved to where they are in light (luma_shift.h), by the
// colours on their sides, and are uncertain by a quarter of the way. In large pictures only if the
// colours are wanted or have been needed before; else, beside coloured ground, the edges are
// uncertain by a tenth of their blur.
void UndoLumaShift(const BladeView& view, Plan plan, Blades* blades);

}  // namespace bladecurve
