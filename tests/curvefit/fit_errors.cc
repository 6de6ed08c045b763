// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "fit_errors.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {

double LargestDifference(
    const BladeCurve& a, const BladeCurve& b, double theta_rad, double x_min_mm, double x_max_mm) {
  double largest = 0;
  constexpr int kPlaces = 101;
  for (int i = 0; i < kPlaces; ++i) {
    const double x = x_min_mm + (x_max_mm - x_min_mm) * i / (kPlaces - 1);
    largest =
        std::max(largest, std::abs(a.Eval(x, theta_rad).phi_mm - b.Eval(x, theta_rad).phi_mm));
  }
  return largest;
}

bool Warned(const BladeFit& fit, const std::string& code) {
  return std::find(fit.warnings.begin(), fit.warnings.end(), code) != fit.warnings.end();
}

bool Noted(const BladeFit& fit, const std::string& code) {
  return std::find(fit.notes.begin(), fit.notes.end(), code) != fit.notes.end();
}

const FamilyFit& TaperedOf(const BladeFit& fit) {
  const bool first = std::holds_alternative<TaperedRectangle>(fit.recommended.curve.shape());
  return first ? fit.recommended : fit.alternatives.front();
}

}  // namespace bladecurve
