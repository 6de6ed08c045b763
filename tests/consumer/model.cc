// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>

#include "model/blade_curve.h"

// phi of the paper's small scissors at 30 degrees, 50 mm from the pivot, against eq. (19) by hand.
int main() {
  const double theta_rad = 0.5235987755982988;
  const bladecurve::BladeCurve curve(bladecurve::TaperedRectangle{-11, 0.14, 0.5}, {0, 100, 0, 1});
  const double expected_mm = -11 + 50 * (0.14 + 0.5 * std::tan(theta_rad / 2));
  const double phi_mm = curve.Eval(50, theta_rad).phi_mm;
  return std::abs(phi_mm - expected_mm) < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}
