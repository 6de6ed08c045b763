// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/located_blade.h"

namespace bladecurve {

// An edge that strays from some place on all the way to the tip is looked for there as the other
// one, if that does not, goes on: mirrored, and moved to where the rest of it lies. It is taken if
// it is clear then and not much vaguer. Else no more than its end is, if a tip's arc is certain
// there and none was seen before.
void FindLostEnds(const BladeView& view, Blades* blades);

}  // namespace bladecurve
