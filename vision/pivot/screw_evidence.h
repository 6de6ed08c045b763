// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/screw.h"
#include "vision/pivot/screw_rim.h"
#include "vision/pivot/screw_steepest.h"

namespace bladecurve {

inline constexpr double kLeastSemiAxisPx = 3.5;  // of a head that can be told from a speck
// Flatter: half a head cut off by its slot, not a tilted circle.
inline constexpr double kLeastAxisRatio = 0.75;

// A rim that may be the head's; natural logarithms of odds.
struct FoundRim {
  RimFit fit;              // in picture pixels
  double evidence = 0;     // that it is a head's at all
  double preference = 0;   // beside other rims of the same head
  bool one_sided = false;  // a third of it does not show at all, as of tips and corners
};

// What is seen of a rim.
struct RimSigns {
  RimFit fit;               // in picture pixels
  double judged_radius_px;  // mean, at the scale at which the rim was judged
  double contrast;          // RimField::ScoreWithoutTangents
  SteepestCircle steepest;  // share 0 where that is not the rim
};

// What speaks for it. How well it is fitted says which of several rims is the head's, but little of
// whether it is a head's.
[[nodiscard]] FoundRim WeighRim(const RimSigns& signs, const ScrewSearch& search);

}  // namespace bladecurve
