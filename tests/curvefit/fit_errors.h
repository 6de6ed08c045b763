// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "curvefit/fit.h"
#include "model/blade_curve.h"

namespace bladecurve {

// Largest difference of phi between two curves at one angle, at 101 places from x_min to x_max.
[[nodiscard]] double LargestDifference(const BladeCurve& a,
                                       const BladeCurve& b,
                                       double theta_rad,
                                       double x_min_mm = 15,
                                       double x_max_mm = 50);

// Whether a warning was given.
[[nodiscard]] bool Warned(const BladeFit& fit, const std::string& code);

// Whether a note was made.
[[nodiscard]] bool Noted(const BladeFit& fit, const std::string& code);

// The fit of the tapered family, wherever it stands.
[[nodiscard]] const FamilyFit& TaperedOf(const BladeFit& fit);

}  // namespace bladecurve
