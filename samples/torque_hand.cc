// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_hand.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

constexpr double kKgPerNs2PerMm = 1000;  // 1 kg = 1e-3 N s^2/mm
constexpr double kBent_mm = 0.1;         // of a plate under way to its cut: paper bends 0.12 mm
constexpr double kNeverCut_n_per_mm = 1e12;
constexpr double kNudge_mm = 1e-3;  // of the handle: small beside the 1 mm that bends the plate
constexpr int kTicks = 20000;       // in which 0.1 % of stiffness more or less grows or decays

struct Matrix {
  double a = 1, b = 0, c = 0, d = 1;
};

Matrix Product(const Matrix& p, const Matrix& q) {
  return {
      p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
}

// exp(rate time) by Taylor's series for a 2^-k part of the time, squared k times.
Matrix Exponential(const Matrix& rate, double time_s) {
  const double size =
      time_s * std::max(std::abs(rate.a) + std::abs(rate.b), std::abs(rate.c) + std::abs(rate.d));
  const int halvings = std::max(0, static_cast<int>(std::ceil(std::log2(size))) + 3);
  const double part_s = std::ldexp(time_s, -halvings);
  Matrix sum, term;
  for (int k = 1; k <= 14; ++k) {  // (1/8)^14/14! is below the last bit
    term = Product(term, rate);
    for (double* entry : {&term.a, &term.b, &term.c, &term.d}) *entry *= part_s / k;
    sum = {sum.a + term.a, sum.b + term.b, sum.c + term.c, sum.d + term.d};
  }
  for (int k = 0; k < halvings; ++k) sum = Product(sum, sum);
  return sum;
}

void RequireAboveZero(const char* name, double value) {
  if (std::isfinite(value) && value > 0) return;
  throw std::invalid_argument(std::string("hand: ") + name + " is " + std::to_string(value) +
                              ", must be positive and finite");
}

// The angle at which the plate's edge is bent by kBent_mm.
double BentAngle(const HeldScissors& scissors) {
  const auto bends = [&scissors](double theta_rad) {
    const double phi_mm = scissors.blade.Eval(scissors.span.edge_mm, theta_rad).phi_mm;
    return 0.5 * scissors.thickness_mm - phi_mm >= kBent_mm;
  };
  double low = scissors.blade.domain().theta_min_rad, high = scissors.blade.domain().theta_max_rad;
  if (!bends(low) || bends(high)) {
    throw std::invalid_argument(
        "hand: the blade does not come to bend the plate by 0.1 mm where it begins; move the "
        "plate");
  }
  for (int i = 0; i < 60; ++i) {  // to the last bit
    const double middle = 0.5 * (low + high);
    (bends(middle) ? low : high) = middle;
  }
  return low;
}

// Whether a nudged handle comes to rest on a plate of this stiffness.
bool ComesToRest(const HeldScissors& scissors,
                 const Hand& hand,
                 double rate_hz,
                 double stiffness_n_per_mm) {
  const double rest_rad = BentAngle(scissors);
  const Material plate{
      "uncut", kNeverCut_n_per_mm, scissors.thickness_mm, ForceDeflection(stiffness_n_per_mm)};
  TorqueModel model(scissors.blade, plate, scissors.span);
  const HandMotion motion(hand, 1 / rate_hz);
  const double rest_n = model.Step(rest_rad, 0, 0).torque_nmm / scissors.radius_mm;
  const double wanted_mm = rest_n / hand.spring_n_per_mm;
  HandleState state{kNudge_mm, 0};
  double late_mm = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const double theta_rad = rest_rad - state.place_mm / scissors.radius_mm;
    const double force_n = model.Step(theta_rad, 0, 1 / rate_hz).torque_nmm / scissors.radius_mm;
    state = motion.After(state, wanted_mm, force_n);
    if (tick >= kTicks / 2) late_mm = std::max(late_mm, std::abs(state.place_mm));
  }
  return late_mm < kNudge_mm;
}

}  // namespace

// About the place of rest, wanted - force/spring:  m z'' + damping z' + spring z = 0.
HandMotion::HandMotion(const Hand& hand, double tick_s) : spring_n_per_mm_(hand.spring_n_per_mm) {
  RequireAboveZero("mass_kg", hand.mass_kg);
  RequireAboveZero("spring_n_per_mm", hand.spring_n_per_mm);
  RequireAboveZero("damping_n_s_per_mm", hand.damping_n_s_per_mm);
  RequireAboveZero("tick_s", tick_s);
  const double per_mass = kKgPerNs2PerMm / hand.mass_kg;
  const Matrix rate{0, 1, -hand.spring_n_per_mm * per_mass, -hand.damping_n_s_per_mm * per_mass};
  const Matrix tick = Exponential(rate, tick_s);
  place_by_place_ = tick.a;
  place_by_speed_s_ = tick.b;
  speed_by_place_per_s_ = tick.c;
  speed_by_speed_ = tick.d;
}

HandleState HandMotion::After(const HandleState& state,
                              double wanted_mm,
                              double force_n) const noexcept {
  const double rest_mm = wanted_mm - force_n / spring_n_per_mm_;
  const double z = state.place_mm - rest_mm, v = state.speed_mm_per_s;
  return {rest_mm + place_by_place_ * z + place_by_speed_s_ * v,
          speed_by_place_per_s_ * z + speed_by_speed_ * v};
}

double LargestStableStiffness(const HeldScissors& scissors, const Hand& hand, double rate_hz) {
  constexpr double kAccuracy = 1e-3, kMost_n_per_mm = 1e9;
  RequireAboveZero("rate_hz", rate_hz);
  RequireAboveZero("radius_mm", scissors.radius_mm);
  double low = 1e-6, high = 1;  // stable, and later not stable
  while (high < kMost_n_per_mm && ComesToRest(scissors, hand, rate_hz, high)) {
    low = high;
    high *= 10;
  }
  while (high / low > 1 + kAccuracy) {
    const double middle = std::sqrt(low * high);
    (ComesToRest(scissors, hand, rate_hz, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace bladecurve
