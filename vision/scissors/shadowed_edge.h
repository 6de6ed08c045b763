// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/pivot.h"
#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Edges that mirror each other but for a little, of which the outer one may be a shadow's border:
// it is taken to the place where a shadow begins, where the other one puts it, if that accounts for
// the difference. Returns whether it was.
[[nodiscard]] bool RelocateShadowedOne(const BladeView& view, const Pivot& pivot, Blades* blades);

// A lamp behind the blades lays hard shadows beside both edges. Their borders mirror each other
// less well than the edges within do: if so, both are taken there. Returns whether they were.
[[nodiscard]] bool LeaveBothShadows(const BladeView& view, const Pivot& pivot, Blades* blades);

}  // namespace bladecurve
