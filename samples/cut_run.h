// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/friction.h"
#include "model/torque.h"
#include "samples/cut_motion.h"

namespace bladecurve {

// One sample of a cut, with all that the CSV shows.
struct CutRow {
  MotionSample motion;
  TorqueSample cut;
  double friction_n = 0;
  double force_n =
      std::numeric_limits<double>::quiet_NaN();  // at the handle: torque over radius, and friction
};

struct CutRun {
  std::vector<CutRow> rows;
  std::vector<TorqueEvent> events;
  CutLedger ledger;
  double toughness_n = 0;  // J_c h: work of a millimetre of cut, N mm/mm
};

// A new plate cut along the motion. radius_mm: pivot to handle, NaN if unknown. No friction: none
// is added.
[[nodiscard]] CutRun RunCut(TorqueModel model,
                            const std::vector<MotionSample>& motion,
                            double radius_mm,
                            const std::optional<FrictionCurve>& friction);

// t_s,theta_deg,pivot_mm,phase,x_c_mm,delta_mm,torque_nmm,force_n,force_x_n,friction_n,flags, and
// measured_n if the motion has it. Unknown values are empty; flags are the sum of CurveFlag and
// TorqueFlag bits.
[[nodiscard]] std::string CutCsv(const CutRun& run);

// Phases, angles, peak, work audit and, if a force was measured, the error in each phase: for a
// person, by lines.
[[nodiscard]] std::string CutSummary(const CutRun& run);

// "none", "deformation", "cutting", "relaxation", "through".
[[nodiscard]] const char* PhaseName(Phase phase);

}  // namespace bladecurve
