// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/scissors/blade_view.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// What becomes of the other blade's edge, coming in from its tip, in the band between the border of
// a blade and a line on it.
enum class Occlusion {
  kUntold,  // it does not show well enough
  kNone,    // it is seen within: that is ground, or a shadow on it
  kHidden,  // it ends at the border, in a T-junction: the band is the top blade's bevel
};

// `border`, from the crotch on, lies further out than the line `inner` that the blade's edge was
// found at. Not kHidden where a shadow might hide the edge, as dark on the ground as the other
// blade is.
[[nodiscard]] Occlusion OcclusionUpTo(const std::vector<LocatedEdgePoint>& border,
                                      const BladeView& view,
                                      const LocatedBlade& inner,
                                      const LocatedBlade& other);

}  // namespace bladecurve
