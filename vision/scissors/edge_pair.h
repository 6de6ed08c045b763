// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/blade_view.h"
#include "vision/stage_log.h"

namespace bladecurve {

// Locates both edges beside the traces of the scene, at full resolution along the blades only. Dark
// bands along both are taken for shadows, edges at which light alone changes are left for where the
// ground's colour ends, or doubted, and the line of a dim bevel for its border; what the other
// blade's edge tells of a band is in no doubt. The lower edge may be the trace itself where nothing
// better is to be had: ambiguity 1, sigma as large as the trace's. Throws Refused as LocateEdge
// does for the upper edge.
[[nodiscard]] BladeEdges LocateBlades(const BladeView& view, Plan plan = Plan::kAsNeeded);

}  // namespace bladecurve
