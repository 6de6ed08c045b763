// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/scissors/blade_view.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// Whether a blade hides the other one up to `border`, which lies further out than the line `inner`
// that its edge was found at: the other blade's edge, coming in from its tip, ends there in a
// T-junction, and the band between is the top blade's bevel. In a shadow the edge would go on to be
// seen. `border`: from the crotch on. Not where the edge does not show well enough to tell, or
// where a shadow might hide it, as dark on the ground as the other blade is.
[[nodiscard]] bool IsOccludingBorder(const BladeView& view,
                                     const std::vector<LocatedEdgePoint>& border,
                                     const LocatedBlade& inner,
                                     const LocatedBlade& other);

}  // namespace bladecurve
