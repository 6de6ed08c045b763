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
