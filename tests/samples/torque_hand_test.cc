// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_hand.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

// The hand's equation in a thousand steps of Runge and Kutta.
HandleState Integrated(
    const Hand& hand, HandleState state, double wanted_mm, double force_n, double tick_s) {
  constexpr int kSteps = 1000;
  const double step_s = tick_s / kSteps;
  const auto rate = [&](const HandleState& s) {
    const double pull_n = hand.spring_n_per_mm * (wanted_mm - s.place_mm) -
                          hand.damping_n_s_per_mm * s.speed_mm_per_s - force_n;
    return HandleState{s.speed_mm_per_s, pull_n * 1000 / hand.mass_kg};
  };
  const auto moved = [](const HandleState& s, const HandleState& r, double by_s) {
    return HandleState{s.place_mm + by_s * r.place_mm, s.speed_mm_per_s + by_s * r.speed_mm_per_s};
  };
  for (int i = 0; i < kSteps; ++i) {
    const HandleState k1 = rate(state), k2 = rate(moved(state, k1, step_s / 2));
    const HandleState k3 = rate(moved(state, k2, step_s / 2)), k4 = rate(moved(state, k3, step_s));
    for (const auto& [k, weight] : {std::pair(k1, 1.0), {k2, 2.0}, {k3, 2.0}, {k4, 1.0}})
      state = moved(state, k, weight * step_s / 6);
  }
  return state;
}

Hand RandomHand(std::mt19937& random) {
  return {std::exp(Uniform(random, -5, 0)),
          std::exp(Uniform(random, -3, 1)),
          std::exp(Uniform(random, -8, -2))};
}

TEST(HandMotion, FollowsItsEquation) {
  std::mt19937 random(1);
  constexpr double kIntegration = 1e-9;
  for (int trial = 0; trial < 50; ++trial) {
    const Hand hand = RandomHand(random);
    const double tick_s = std::exp(Uniform(random, -9, -4));
    const HandleState from{Uniform(random, -5, 5), Uniform(random, -100, 100)};
    const double wanted_mm = Uniform(random, -5, 5), force_n = Uniform(random, -2, 2);
    const HandleState to = HandMotion(hand, tick_s).After(from, wanted_mm, force_n);
    const HandleState truth = Integrated(hand, from, wanted_mm, force_n, tick_s);
    EXPECT_NEAR(to.place_mm, truth.place_mm, kIntegration * 10) << trial;
    EXPECT_NEAR(to.speed_mm_per_s, truth.speed_mm_per_s, kIntegration * 1000) << trial;
  }
}

HeldScissors Held(const BladeCurve& blade, PlateSpan span) { return {blade, span, 0.1, 98}; }

// Newtons at the handle for a millimetre of it, per N/mm of plate, where the edge is bent by 0.1
// mm.
double Lever(const HeldScissors& held) {
  double low = 0, high = 1.2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double delta_mm = 0.05 - held.blade.Eval(held.span.edge_mm, middle).phi_mm;
    (delta_mm > 0.1 ? low : high) = middle;
  }
  const auto force_n = [&](double theta_rad) {
    TorqueModel model(held.blade, {"uncut", 1e12, 0.1, ForceDeflection(1)}, held.span);
    return model.Step(theta_rad, 0, 0).torque_nmm / held.radius_mm;
  };
  constexpr double kTurn_rad = 1e-6;
  return (force_n(low - kTurn_rad) - force_n(low + kTurn_rad)) / (2 * kTurn_rad * held.radius_mm);
}

// Jury's conditions on the loop's linear map: both eigenvalues inside the unit circle.
bool IsStable(const Hand& hand, double tick_s, double handle_n_per_mm) {
  const HandleState by_place = Integrated(hand, {1, 0}, 0, handle_n_per_mm, tick_s);
  const HandleState by_speed = Integrated(hand, {0, 1}, 0, 0, tick_s);
  const double trace = by_place.place_mm + by_speed.speed_mm_per_s;
  const double determinant =
      by_place.place_mm * by_speed.speed_mm_per_s - by_speed.place_mm * by_place.speed_mm_per_s;
  return determinant < 1 && std::abs(trace) < 1 + determinant;
}

TEST(LargestStableStiffness, IsWhereAnEigenvalueOfTheLoopLeavesTheUnitCircle) {
  constexpr double kSought = 3e-3;  // what the search promises, and what the nudge bends beyond it
  const std::array scenes = {Held(SmallMetzenbaum(), {45, 68}), Held(CurvedBlade(), {25, 60})};
  for (const HeldScissors& held : scenes) {
    for (const double rate_hz : {1000.0, 4000.0, 8000.0}) {
      for (const double damping : {0.002, 0.005, 0.02}) {
        const Hand hand{0.1, 0.5, damping};
        double low = 1e-3, high = 1e6;
        while (high / low > 1 + 1e-6) {
          const double middle = std::sqrt(low * high);
          (IsStable(hand, 1 / rate_hz, middle * Lever(held)) ? low : high) = middle;
        }
        EXPECT_NEAR(LargestStableStiffness(held, hand, rate_hz) / low, 1, kSought)
            << rate_hz << " Hz, damping " << damping;
        // Colgate and Brown's rule for a light damping.
        EXPECT_NEAR(low * Lever(held) / (2 * damping * rate_hz), 1, 0.2);
      }
    }
  }
}

TEST(LargestStableStiffness, NamesWhatCannotBe) {
  const HeldScissors held = Held(SmallMetzenbaum(), {45, 68});
  EXPECT_THROW(static_cast<void>(LargestStableStiffness(held, {0.1, 0.5, 0}, 1000)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(LargestStableStiffness(held, {}, 0)), std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(LargestStableStiffness(Held(SmallMetzenbaum(), {150, 160}), {}, 1000)),
      std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
