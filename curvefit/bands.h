// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "curvefit/fit.h"

namespace bladecurve {

// Standard uncertainties at one (x, theta).
struct CurveSigma {
  double phi_mm = 0, phi_x = 0, phi_theta_mm_per_rad = 0;
};

// How far a fitted curve may be off, everywhere: the covariance of its parameters carried to phi
// and its derivatives, and to the cutting torque. A band of 95 % is 1.96 sigma to either side.
// Invariant: holds one pair of displaced curves for every direction in which the parameters are
// uncertain.
class CurveBand {
 public:
  explicit CurveBand(const FamilyFit& fit);

  [[nodiscard]] CurveSigma At(double x_mm, double theta_rad) const;

  // Relative uncertainty of the sharp-cutting torque J_c h phi_theta/phi_x of a thin plate (at phi
  // = 0); nothing where the edge does not cross the axis.
  [[nodiscard]] std::optional<double> TorqueAt(double theta_rad) const;

 private:
  struct Displaced {
    BladeCurve plus, minus;
  };
  BladeCurve curve_;
  std::vector<Displaced> displaced_;
};

}  // namespace bladecurve
