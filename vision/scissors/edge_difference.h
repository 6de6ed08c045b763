// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/pivot.h"
#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// One of two blades, and the other.
struct ChosenBlade {
  LocatedBlade& blade;
  const LocatedBlade& other;
};
[[nodiscard]] ChosenBlade OneOf(Blades* blades, bool upper);

// EdgeAsymmetry of two blades, as seen from straight above where that is known.
[[nodiscard]] double AsymmetryOf(const BladeView& view,
                                 const Pivot& pivot,
                                 const LocatedBlade& a,
                                 const LocatedBlade& b);

// A share of the blades' length, px.
[[nodiscard]] double ShareInPx(double share, const Pivot& pivot, const Blades& blades);

// Whether it is the other blade's mirror image that lies further out.
[[nodiscard]] bool LiesInwards(const LocatedBlade& blade, const Pivot& pivot);

// Of edges that do not mirror each other, the inner one.
[[nodiscard]] ChosenBlade InnerOne(const Pivot& pivot, Blades* blades);

// Doubts the less certain of the two edges: it may lie that far off.
void DoubtVaguerOne(double off_px, Blades* blades);

}  // namespace bladecurve
