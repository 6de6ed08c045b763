// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/friction.h"
#include "model/torque.h"
#include "samples/cut_motion.h"
#include "samples/torque_hand.h"

namespace bladecurve {

struct RealTimeOptions {
  double rate_hz = 1000;
  double seconds = 0;  // closes through a new plate again and again so long; 0: once
  double radius_mm = 0;
  Hand hand;
  std::optional<FrictionCurve> friction;  // Coulomb level of a stick-slide friction at the handle
};

// What a loop against the clock did. Times by the steady clock.
struct RealTimeRun {
  std::vector<MotionSample> motion;  // of the handle, through the first plate
  std::vector<double> period_us;     // from one wake-up to the next
  std::vector<double> compute_us;    // of one step of the model, from call to return
  int missed = 0;                    // ticks that were not done when the next one was due
};

// A loop at rate_hz: wakes, steps the model (and friction) at the angle of a simulated hand that is
// drawn along `wanted`, gives the hand the force. Nothing is allocated while it runs.
// Throws std::invalid_argument for options that cannot be, or more than ten million ticks.
[[nodiscard]] RealTimeRun RunRealTime(TorqueModel model,
                                      const std::vector<MotionSample>& wanted,
                                      const RealTimeOptions& options);

// Percentiles and histograms of both times, missed deadlines and the largest stable stiffness
// beside the material's: for a person, by lines.
[[nodiscard]] std::string RealTimeSummary(const RealTimeRun& run,
                                          const RealTimeOptions& options,
                                          double stable_n_per_mm,
                                          double stiffness_n_per_mm);

}  // namespace bladecurve
