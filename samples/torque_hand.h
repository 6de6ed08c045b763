// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "model/torque.h"

namespace bladecurve {

// A hand that closes haptic scissors: a mass at the handle, drawn by a spring to where the hand
// wants it, damped, against a force that the loop renders and the device holds for a tick.
struct Hand {
  double mass_kg = 0.1;               // finger and handle
  double spring_n_per_mm = 0.5;       // of a relaxed finger
  double damping_n_s_per_mm = 0.005;  // of finger and device together
};

// Place and speed of the handle along its path, growing as the scissors close.
struct HandleState {
  double place_mm = 0, speed_mm_per_s = 0;
};

// The hand over ticks of equal length; exact, since the force is constant within a tick.
class HandMotion {
 public:
  // Throws std::invalid_argument for a hand or a tick that is not above zero.
  HandMotion(const Hand& hand, double tick_s);

  // wanted_mm: where the hand draws the handle; force_n: of the device, resisting closing.
  [[nodiscard]] HandleState After(const HandleState& state,
                                  double wanted_mm,
                                  double force_n) const noexcept;

 private:
  double spring_n_per_mm_;
  // From (place, speed) before a tick to those after it, about the place of rest.
  double place_by_place_, place_by_speed_s_, speed_by_place_per_s_, speed_by_speed_;
};

// Scissors and plate as the hand meets them.
struct HeldScissors {
  BladeCurve blade;
  PlateSpan span;
  double thickness_mm = 0;
  double radius_mm = 0;  // from the pivot to the handle
};

// The largest stiffness k (N/mm) of a plate, uncut, on which the hand comes to rest while the loop
// runs at this rate; to 0.1 %, at most 1e9. Found by simulating the loop where the plate's edge is
// bent by 0.1 mm. The handle's stiffness there, k times a lever's square, is about 2 damping rate
// (Colgate and Brown 1994), less what the hand's own spring takes. Throws std::invalid_argument
// where the blade cannot bend the plate so far, or for numbers that are not above zero.
[[nodiscard]] double LargestStableStiffness(const HeldScissors& scissors,
                                            const Hand& hand,
                                            double rate_hz);

}  // namespace bladecurve
