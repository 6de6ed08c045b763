// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "samples/analysis.h"
#include "samples/validation_run.h"
#include "vision/render/render.h"

namespace bladecurve {

// What the result of one photograph says, its pose as the fit refined it, against what is true, in
// the order of Quantity. Edge, of the upper and of the lower blade: distance of its points from the
// true edge, px, rms; their mean is the stated offset. Pivot: px from the line between the pivot at
// the height of the edges and the centre of the screw's head. Theta: deg. Scale: ppm. Phi: mm, rms
// over the free edge at the true theta. Torque of sharp cutting (Mahvash 2008, eq. 15) at the point
// of contact, a third to all of the true theta: percent, rms.
[[nodiscard]] std::array<QuantityErrors, kQuantities> CompareWithTruth(const Analysis& analysis,
                                                                       const SceneTruth& truth);

}  // namespace bladecurve
