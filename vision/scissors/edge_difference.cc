// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_difference.h"

#include "vision/pivot/pivot_geometry.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {

ChosenBlade OneOf(Blades* blades, bool upper) {
  return upper ? ChosenBlade{blades->upper, blades->lower}
               : ChosenBlade{blades->lower, blades->upper};
}

double AsymmetryOf(const BladeView& view,
                   const Pivot& pivot,
                   const LocatedBlade& a,
                   const LocatedBlade& b) {
  return EdgeAsymmetry(SeenFromAbove(view.scale(), PairOf(a, b), pivot.point_px), pivot.point_px);
}

double ShareInPx(double share, const Pivot& pivot, const Blades& blades) {
  return share * BladeLengthPx(pivot, blades);
}

bool LiesInwards(const LocatedBlade& blade, const Pivot& pivot) {
  return blade.on_left ? pivot.asymmetry < 0 : pivot.asymmetry > 0;
}

ChosenBlade InnerOne(const Pivot& pivot, Blades* blades) {
  return OneOf(blades, LiesInwards(blades->upper, pivot));
}

void DoubtVaguerOne(double off_px, Blades* blades) {
  const bool upper_vaguer = TotalSigma(blades->upper.edge) > TotalSigma(blades->lower.edge);
  Doubt(&OneOf(blades, upper_vaguer).blade.edge, off_px);
}

}  // namespace bladecurve
