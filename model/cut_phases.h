// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "model/blade_curve.h"
#include "model/plate.h"

namespace bladecurve {

// The blade that cuts and the plate it cuts, as far as known before the material is.
struct CutScene {
  BladeCurve blade;
  PlateSpan span;
  double thickness_mm = 0;  // h
  // How well phi and the encoder know the deflection; infinite: contact is where the log shows it.
  double contact_sigma_mm = std::numeric_limits<double>::infinity();
};

// A cut less its friction: what the plate alone resists with, along falling angles.
struct PlateLog {
  std::string source;  // for messages
  std::vector<double> theta_rad, torque_nmm;
};

// Where the phases of a cut meet, and the deformation between the first two of them.
struct CutPhases {
  double contact_rad = 0, start_rad = 0;  // the blade meets the plate; the crack starts
  double end_rad = 0;                     // just beyond the end of the plate, or the log's end
  bool through = false;                   // the plate ended, not the log
  double stiffness_n_per_mm = 0;          // k, slope of the force over the deflection (eq. 22)
  double deflection_mm = 0;               // delta, counted from contact, when the crack starts
  double contact_offset_mm = 0;           // h/2 - phi at contact: 0 where phi is exact
};

// Finds them by least squares over contact and start of the cut (deformation_ramp.h), within 1 mm
// of crack or 2.5 times the deflection of them. Contact is drawn to where phi has it as far as that
// is known, unless the log contradicts by over 3 standard deviations; then k rests on differences
// of phi alone. Throws LogRefused ("no_cut", "too_short") where a phase is
// missing or shows in fewer than 5 rows.
[[nodiscard]] CutPhases FindCutPhases(const PlateLog& log, const CutScene& scene);

// x at which the edge bends the plate by delta (5): the first in the blade's domain; an end of the
// domain if there is none.
[[nodiscard]] double MeetingPoint(const CutScene& scene,
                                  double delta_mm,
                                  double theta_rad) noexcept;

}  // namespace bladecurve
