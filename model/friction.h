// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/number_table.h"

namespace bladecurve {

// Handle force of the empty scissors against the opening angle, for both directions (the paper's
// Fig. 5). Positive resists closing, so that the force of opening is usually negative. Invariant:
// ascending angles, as many forces. Linear between the angles, constant beyond the first and the
// last.
class FrictionCurve {
 public:
  // Throws std::invalid_argument unless there are one or more angles, strictly ascending, and as
  // many forces.
  FrictionCurve(std::vector<double> theta_rad,
                std::vector<double> closing_n,
                std::vector<double> opening_n);

  // Real-time safe.
  [[nodiscard]] double Closing(double theta_rad) const noexcept;
  [[nodiscard]] double Opening(double theta_rad) const noexcept;

 private:
  [[nodiscard]] double Interpolate(const std::vector<double>& force_n,
                                   double theta_rad) const noexcept;

  std::vector<double> theta_rad_, closing_n_, opening_n_;
};

// From columns theta_deg, closing_n and, if measured, opening_n (else -closing_n), in ascending or
// descending angle. Throws std::invalid_argument naming file and line.
[[nodiscard]] FrictionCurve FrictionOfTable(const NumberTable& table);

// Which way the handles move, remembered at a standstill.
enum class Direction { kUnknown, kClosing, kOpening };

// Friction for rendering: Hayward and Armstrong (2000), Coulomb case. A spring of stiffness sigma_0
// between the handle and a point of contact w, which follows once it is stretched to z_max; force =
// sigma_0 (x - w). Free of drift: while the handle moves by less than z_max, w stays where it is,
// so that noise moves nothing.
class StickSlide {
 public:
  // z_max: the elastic play of the handle before it slides. Throws std::invalid_argument unless
  // positive and finite.
  explicit StickSlide(double z_max_mm);

  // x: position of the handle along its path, growing as the scissors close; coulomb: the force
  // while sliding, >= 0. A Coulomb level that changes with x changes sigma_0 = coulomb/z_max, not
  // w. Real-time safe; an input that is not finite gives the last force again.
  double Step(double x_mm, double coulomb_n) noexcept;

  void Reset() noexcept;

 private:
  double z_max_mm_;
  double contact_mm_ = 0;  // w
  double force_n_ = 0;
  bool started_ = false;
};

}  // namespace bladecurve
