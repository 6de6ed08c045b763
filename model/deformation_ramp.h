// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bladecurve {

struct DeformationRow {
  double delta_mm = 0;  // deflection of the plate's edge, counted from anywhere
  double force_n = 0;
};

// No force up to contact, then k times the deflection, then, from the start of the cut on, a
// straight line; continuous.
struct DeformationRamp {
  double contact_mm = 0, width_mm = 0;  // width: deflection from contact to the start of the cut
  double stiffness_n_per_mm = 0;        // k (eq. 22)
  int rows = 0;                         // between the two
  double noise_n = 0;                   // standard deviation of the rows from it
};

struct RampSearch {
  double middle_mm = 0;       // the middle of the rise lies near here,
  double width_mm = 0;        // its width is a tenth to three times this; must be positive
  double contact_weight = 0;  // N^2/mm^2: contact^2 times this is added to the squares
};

// The ramp of least squares.
[[nodiscard]] DeformationRamp FitDeformationRamp(std::vector<DeformationRow> rows,
                                                 const RampSearch& search);

}  // namespace bladecurve
