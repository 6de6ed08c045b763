// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "model/blade_curve.h"
#include "model/plate.h"
#include "model/torque_state.h"

namespace bladecurve {

// Scissors cutting one plate, stepped along a motion. Quasi-static: time enters nowhere but in
// longest_step_s. Invariant: the crack never heals, the plate's crack tip never moves towards the
// pivot's first position. One instance is one plate; instances share nothing; equal calls give
// equal bits. Copy it to branch a motion.
//
// Energy, from an untouched plate on and without fluctuation: with the pivot at rest, the work of
// the hand so far, -integral of tau dtheta, is never negative, however the blades move; with the
// angle at rest, -integral of f_x dX_p never is. Where both move, nothing is guaranteed: the
// paper's torque (2) and force on the pivot (18) have no common potential, since x cos(alpha) phi_x
// is not phi_theta sin(theta/2 - alpha), and a loop run the right way round gives energy without
// cutting anything. A host that lets the pivot move must watch its energy (a passivity controller).
class TorqueModel {
 public:
  // Throws std::invalid_argument for a material, span or option that cannot be.
  TorqueModel(BladeCurve blade, Material material, PlateSpan span, TorqueOptions options = {});

  // A new plate.
  void Reset() noexcept;

  // The motion goes on in a straight line to (theta_rad, pivot_mm), dt_s after the step before;
  // everything that happens between is located there. Real-time safe: noexcept, no allocation, no
  // lock, bounded work.
  [[nodiscard]] TorqueSample Step(double theta_rad, double pivot_mm, double dt_s) noexcept;

  // What happened in the last step, in order.
  [[nodiscard]] std::span<const TorqueEvent> events() const noexcept {
    return {events_.events.data(), events_.count};
  }

  [[nodiscard]] const CutLedger& ledger() const noexcept { return state_.ledger; }
  [[nodiscard]] const BladeCurve& blade() const noexcept { return blade_; }
  [[nodiscard]] const Material& material() const noexcept { return material_; }

 private:
  [[nodiscard]] TorqueSample Unsafe(std::uint32_t flag) noexcept;

  BladeCurve blade_;
  Material material_;
  PlateSpan span_;
  TorqueOptions options_;
  TorqueState state_;
  EventLog events_;
};

}  // namespace bladecurve
