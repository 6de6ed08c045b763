// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "model/blade_file.h"
#include "model/cut_phases.h"
#include "model/force_log.h"

namespace bladecurve {

// Mean of several cuts, and how well it is known; NaN: not known.
struct Identified {
  double mean = 0;
  double deviation = std::numeric_limits<double>::quiet_NaN();    // standard, of one cut
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  // of the mean: +-2 hold 95 %
  double from_blade = 0;  // the share of the uncertainty that phi's covariance makes
};

struct IdentifiedCut {
  std::string source;
  CutPhases phases;
  double length_mm = 0;         // l_c
  double length_by_phi_mm = 0;  // where the blade was at the end, seen from the plate's edge
  double toughness_n_per_mm = 0;
};

// What a material is, from cuts of it. Doubts are stable codes: "one_cut" (no scatter, no
// uncertainty), "one_empty_run" (the uncertainty leaves friction out), "blade_uncertainty_unknown"
// (it leaves phi out), "length_mismatch" (phi puts the plate's end more than 5 % of the cut from
// where it was said to be), "contact_offset" (phi puts contact more than 0.5 mm off).
struct Identification {
  Identified toughness_n_per_mm;  // J_c (eq. 21); the same number in kJ/m^2
  Identified stiffness_n_per_mm;  // k (eq. 22)
  std::vector<IdentifiedCut> cuts;
  std::vector<std::string> doubts;
};

struct IdentifyInput {
  std::vector<ForceLog> cuts, empties;  // one of each at least; the more, the better known
  BladeFile blade;                      // its covariance counts
  PlateSpan span;                       // where every plate lay; taken as exact, like h
  double thickness_mm = 0;              // h
};

// J_c h l_c = work of the cutting phase less the empty scissors' over the same angles (21); l_c is
// the plate's width, or what phi says where the log ends within the plate. k from the deformation
// phase (cut_phases.h). The uncertainty joins, as halves of 95 % intervals (Student's t), the
// scatter of the cuts, the empty runs' (jackknife) and phi's (linear in its parameters).
// Throws LogRefused naming the file for logs that will not do, std::invalid_argument for input that
// cannot be.
[[nodiscard]] Identification IdentifyMaterial(const IdentifyInput& input);

}  // namespace bladecurve
