// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "model/crack_tip.h"
#include "model/plate.h"

namespace bladecurve {

// High-frequency fluctuation of the cutting torque (III-D of the paper): the crack rests while the
// plate bends and then breaks on by a rupture, again and again. tau = tau_c - dU/dtheta (eq. 16),
// with the energy U that the plate stores between two ruptures.
struct Fluctuation {
  double rupture_mm = 0;  // mean length of a rupture; 0: no fluctuation
  double spread = 0.5;    // lengths vary by up to this share of the mean either way, < 1
  std::uint32_t seed =
      1;  // of the lengths: they are a function of it and of the place in the plate
};

// Throws std::invalid_argument, naming field, value and bound.
void CheckFluctuation(const Fluctuation& fluctuation);

// Resistance of the plate over its mean, J_c h, at a crack tip that cuts; the torque of cutting is
// that many times tau_c. With s the way since the last rupture, L the length of this one and
// kappa = x g'(delta) phi_x^2 cos(alpha)/phi_theta, what a resting crack adds to the resistance for
// a millimetre of way:   1 + kappa (s - L/2)/(J_c h),  never below 0 (kappa <= 2 J_c h/L).
// So U = kappa s (s - L)/2, zero at every rupture, and the work of any stretch of cutting differs
// from J_c h l_c by at most  (L_max^2/8) (max kappa + total variation of kappa on that stretch),
// the mean torque from the mean of tau_c by that over the angle turned. crack_mm: crack tip from
// the pivot's first position. Real-time safe; needs rupture_mm > 0.
[[nodiscard]] double FluctuatingShare(const Fluctuation& fluctuation,
                                      const Material& material,
                                      const CrackTip& tip,
                                      double crack_mm) noexcept;

// The rupture in which a crack tip lies: where it began, how long it is.
struct Rupture {
  double begin_mm = 0, length_mm = 0;
};
[[nodiscard]] Rupture RuptureAt(const Fluctuation& fluctuation, double crack_mm) noexcept;

}  // namespace bladecurve
