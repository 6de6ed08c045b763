// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// What a step of the torque model reports: state in, phase, torque and forces out.
#include <algorithm>

#include "model/torque_step.h"

namespace bladecurve {
namespace {

// A lever shorter than this turns no torque into a finite force.
constexpr double kLeastLever_mm = 1e-9;

bool IsTouching(const CrackTip& tip) {
  return tip.delta_mm > 0 && tip.x_mm > 0 && tip.on_blade > 0;
}

}  // namespace

// Deformation while delta grows, relaxation while it falls; at a standstill as it was.
Phase TorqueStep::ElasticPhase() const noexcept {
  if (!IsTouching(state_.tip)) return Phase::kNone;
  if (state_.tip.delta_mm > leg_start_delta_mm_) return Phase::kDeformation;
  if (state_.tip.delta_mm < leg_start_delta_mm_) return Phase::kRelaxation;
  return state_.output.phase == Phase::kRelaxation ? Phase::kRelaxation : Phase::kDeformation;
}

double TorqueStep::TorqueNow() const noexcept {
  switch (state_.mode) {
    case CutMode::kElastic: {
      const double torque_nmm = ElasticTorque(state_.tip, material_);
      return state_.tip.can_cut ? torque_nmm : std::min(torque_nmm, state_.valid_torque_nmm);
    }
    case CutMode::kCutting:
    case CutMode::kResting:
      return state_.tip.on_blade * CuttingTorque();
    case CutMode::kStuck:
      return state_.valid_torque_nmm;
    case CutMode::kThrough:
      break;
  }
  return 0;
}

double TorqueStep::CuttingTorque() const noexcept {
  const Fluctuation& fluctuation = options_.fluctuation;
  if (fluctuation.rupture_mm == 0) return state_.tip.cut_torque_nmm;
  return state_.tip.cut_torque_nmm *
         FluctuatingShare(fluctuation, material_, state_.tip, state_.crack_mm);
}

void TorqueStep::Report() noexcept {
  const CrackTip& tip = state_.tip;
  TorqueSample& out = state_.output;
  if (state_.mode == CutMode::kElastic) {
    out.phase = ElasticPhase();
  } else {
    out.phase = state_.mode == CutMode::kThrough ? Phase::kThrough : Phase::kCutting;
  }
  out.torque_nmm = TorqueNow();
  const double lever_mm = tip.x_mm * tip.cos_alpha;
  out.normal_force_n = lever_mm > kLeastLever_mm ? out.torque_nmm / lever_mm : 0;
  out.force_x_n = 0 - out.normal_force_n * tip.sin_slope;  // 0, not -0, without contact
  out.x_c_mm = tip.x_mm;
  out.delta_mm = tip.delta_mm;
  out.flags = tip.edge.flags | flags_;
  if (tip.on_blade < 1) out.flags |= kTorqueBeyondBlade;
  const bool acts = out.phase != Phase::kNone && out.phase != Phase::kThrough;
  if (acts && (!tip.can_cut || state_.mode == CutMode::kStuck)) out.flags |= kTorqueCannotCut;
  if (tip.can_cut && state_.mode != CutMode::kStuck) state_.valid_torque_nmm = out.torque_nmm;
}

}  // namespace bladecurve
