// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "model/blade_curve.h"
#include "model/plate.h"

namespace bladecurve {

// The blade at the crack tip: everything the cutting law needs at one (x, theta).
struct CrackTip {
  double x_mm = 0, theta_rad = 0;
  CurveSample edge;
  double delta_mm = 0;   // h/2 - phi (eq. 5); negative: the blade has not reached the plate
  double cos_alpha = 1;  // alpha = theta/2 - atan phi_x, between edge and centre line of the blade
  double sin_slope = 0;  // sin(theta/2 - alpha) = sin(atan phi_x), of eq. (18)
  double on_blade = 1;   // 1 on the blade, 0 beyond its end, smoothly between
  bool can_cut = false;  // phi_x, phi_theta, cos alpha, x positive: eq. (15) has a meaning

  // Sharp cutting (only with can_cut). The cutting force is the one whose torque is tau_c.
  double cut_torque_nmm = 0;                               // tau_c = J_c h phi_theta/phi_x (eq. 15)
  double cut_torque_x_n = 0, cut_torque_theta_nmm = 0;     // its derivatives
  double cut_force_n = 0;                                  // tau_c/(x cos alpha)
  double cut_force_x_n_per_mm = 0, cut_force_theta_n = 0;  // its derivatives
};

// A function that tells which side of an event a point lies on, with its derivatives.
struct Level {
  double value = 0, dx = 0, dtheta = 0;
};

// Real-time safe, like BladeCurve::Eval.
[[nodiscard]] CrackTip EvalCrackTip(const BladeCurve& blade,
                                    const Material& material,
                                    double x_mm,
                                    double theta_rad) noexcept;

// g(delta) - cut force: cutting starts where it reaches zero. Very negative where the blade cannot
// cut.
[[nodiscard]] Level CuttingLevel(const CrackTip& tip, const Material& material) noexcept;

// Torque of the elastic plate, x g(delta) cos alpha (eqs. 1, 2); 0 without contact or for x <= 0.
[[nodiscard]] double ElasticTorque(const CrackTip& tip, const Material& material) noexcept;

}  // namespace bladecurve
