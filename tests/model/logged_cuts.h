// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <string>

#include "model/blade_curve.h"
#include "model/fluctuation.h"
#include "model/plate.h"

namespace bladecurve {

// A test rig that closes the scissors and logs what an encoder and a force sensor read.
struct Rig {
  double rate_hz = 500, rate_deg_per_s = 3;  // the paper's closing rate
  double from_deg = 30, to_deg = 2;
  double encoder_step_deg = 0.01;
  double noise_n = 0.02;    // standard deviation of the force sensor; the paper's resolves 1/80 N
  double force_step_n = 0;  // of its reading; 0: none
  double friction_n = 1.5;  // level of the empty scissors; rises as they close
  double friction_scatter = 0;  // standard deviation from run to run, share of it
  double radius_mm = 98;        // the paper's
};

// A log as CSV text: t_s,theta_deg,force_n. Cut, or empty without a material.
[[nodiscard]] std::string LogOfCut(const Rig& rig,
                                   const BladeCurve& blade,
                                   const Material& material,
                                   PlateSpan span,
                                   std::mt19937& random,
                                   const Fluctuation& fluctuation = {});
[[nodiscard]] std::string LogOfEmptyRun(const Rig& rig, std::mt19937& random);

// A standard normal number, the same on every machine.
[[nodiscard]] double Gauss(std::mt19937& random);

}  // namespace bladecurve
