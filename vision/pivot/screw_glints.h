// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/head_surroundings.h"
#include "vision/pivot/screw_rim.h"

namespace bladecurve {

// Several lamps, or windows, each put a glint on the chamfer of a head. The rim of one that is
// darker than the plate is followed along the glints' inner borders and elsewhere along the
// chamfer's foot, and lies aside of both. Takes the rim's centre to that of the foot, which the
// glints' outer borders show, and counts a third of the way in its covariance. The same rim where
// there are none. `around`: of that rim.
[[nodiscard]] RimFit LeaveGlints(const HeadSurroundings& around, RimFit fit);

}  // namespace bladecurve
