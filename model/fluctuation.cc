// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/fluctuation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

// A number of [-1/2, 1/2) for each whole number and seed (splitmix64, Steele et al. 2014): ruptures
// need no memory, so that copies and replays of a cut agree.
double Jitter(std::uint32_t seed, double number) {
  const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(number));
  std::uint64_t z = index * 0x9e3779b97f4a7c15u + (static_cast<std::uint64_t>(seed) << 32) + seed;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return std::ldexp(static_cast<double>(z >> 11), -53) - 0.5;
}

}  // namespace

void CheckFluctuation(const Fluctuation& fluctuation) {
  // Ruptures shorter than a nanometre or longer than a kilometre are none; their numbers would
  // overflow.
  constexpr double kShortest_mm = 1e-6, kLongest_mm = 1e6;
  const double length_mm = fluctuation.rupture_mm;
  if (length_mm != 0 && !(length_mm >= kShortest_mm && length_mm <= kLongest_mm)) {
    throw std::invalid_argument("fluctuation: rupture length is " + std::to_string(length_mm) +
                                " mm, must be 0 (none) or from 1e-6 to 1e6");
  }
  if (!(fluctuation.spread >= 0 && fluctuation.spread < 1)) {
    throw std::invalid_argument("fluctuation: spread is " + std::to_string(fluctuation.spread) +
                                ", must be from 0 to below 1");
  }
}

// Rupture i begins at (i + spread j_i) times the mean length, |j_i| <= 1/2: in order, and the mean
// of the lengths is the mean length.
Rupture RuptureAt(const Fluctuation& fluctuation, double crack_mm) noexcept {
  constexpr double kMostRuptures = 1e15;  // numbered exactly
  const double place = std::clamp(crack_mm / fluctuation.rupture_mm, -kMostRuptures, kMostRuptures);
  const auto begin = [&](double i) { return i + fluctuation.spread * Jitter(fluctuation.seed, i); };
  double i = std::floor(place);
  if (begin(i) > place) {
    --i;
  } else if (begin(i + 1) <= place) {
    ++i;
  }
  return {begin(i) * fluctuation.rupture_mm, (begin(i + 1) - begin(i)) * fluctuation.rupture_mm};
}

double FluctuatingShare(const Fluctuation& fluctuation,
                        const Material& material,
                        const CrackTip& tip,
                        double crack_mm) noexcept {
  if (!tip.can_cut) return 1;
  const Rupture rupture = RuptureAt(fluctuation, crack_mm);
  const double stiffness_n_per_mm = material.force_deflection.Eval(tip.delta_mm).stiffness_n_per_mm;
  const double resistance_n = material.toughness_n_per_mm * material.thickness_mm;
  const CurveSample& e = tip.edge;
  const double kappa_n_per_mm =
      tip.x_mm * stiffness_n_per_mm * e.phi_x * e.phi_x * tip.cos_alpha / e.phi_theta_mm_per_rad;
  const double rise = std::min(kappa_n_per_mm * rupture.length_mm / resistance_n, 2.0);
  const double way = std::clamp((crack_mm - rupture.begin_mm) / rupture.length_mm, 0.0, 1.0);
  return 1 + rise * (way - 0.5);
}

}  // namespace bladecurve
