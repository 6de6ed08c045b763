// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/torque.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/torque_step.h"

namespace bladecurve {
namespace {

bool IsSafe(const TorqueSample& sample) {
  return std::isfinite(sample.torque_nmm) && std::isfinite(sample.force_x_n) &&
         std::isfinite(sample.x_c_mm) && std::isfinite(sample.delta_mm);
}

}  // namespace

TorqueModel::TorqueModel(BladeCurve blade, Material material, PlateSpan span, TorqueOptions options)
    : blade_(std::move(blade)), material_(std::move(material)), span_(span), options_(options) {
  CheckMaterial(material_);
  CheckPlateSpan(span_);
  CheckFluctuation(options_.fluctuation);
  if (!(options_.longest_step_s > 0)) {
    throw std::invalid_argument("torque: longest_step_s is " +
                                std::to_string(options_.longest_step_s) + ", must be positive");
  }
  Reset();
}

void TorqueModel::Reset() noexcept {
  state_ = TorqueState{};
  state_.crack_mm = span_.edge_mm;
  state_.output.x_c_mm = span_.edge_mm;
  events_.count = 0;
}

TorqueSample TorqueModel::Step(double theta_rad, double pivot_mm, double dt_s) noexcept {
  events_.count = 0;
  if (!std::isfinite(theta_rad) || !std::isfinite(pivot_mm) || !std::isfinite(dt_s) || dt_s < 0) {
    return Unsafe(kTorqueBadInput);
  }
  if (state_.started && dt_s > options_.longest_step_s) return Unsafe(kTorqueStepTooLong);
  if (state_.started && theta_rad == state_.theta_rad && pivot_mm == state_.pivot_mm)
    return state_.output;

  const TorqueState before = state_;
  const MotionPath path = state_.started
                              ? MotionPath{state_.theta_rad, state_.pivot_mm, theta_rad, pivot_mm}
                              : MotionPath{theta_rad, pivot_mm, theta_rad, pivot_mm};
  TorqueStep(blade_, material_, span_.end_mm, options_, path, state_, events_).Run();
  if (!IsSafe(state_.output)) {
    state_ = before;
    return Unsafe(kTorqueBadInput);
  }
  state_.theta_rad = theta_rad;
  state_.pivot_mm = pivot_mm;
  return state_.output;
}

// The last output again, flagged; the motion has not moved on.
TorqueSample TorqueModel::Unsafe(std::uint32_t flag) noexcept {
  events_.count = 0;
  TorqueSample sample = state_.output;
  sample.flags |= flag;
  return sample;
}

}  // namespace bladecurve
