// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/compare_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace bladecurve {
namespace {

constexpr int kAngles = 61, kPlaces = 41;  // of the grid: 1 deg and 1 to 2 mm for common scissors
// "Near closing": nearer, the tapered form's torque goes to infinity and says nothing.
constexpr double kNearClosing = 5 * std::numbers::pi / 180;

double At(double low, double high, int i, int count) {
  return low + (high - low) * i / (count - 1);
}

struct PlaceOfDifference {
  double mm = 0, x_mm = 0;
};

PlaceOfDifference LargestAt(const BladeCurve& a, const BladeCurve& b, double theta_rad) {
  PlaceOfDifference largest;
  for (int i = 0; i < kPlaces; ++i) {
    const double x = At(a.domain().x_min_mm, a.domain().x_max_mm, i, kPlaces);
    const double mm = std::abs(a.Eval(x, theta_rad).phi_mm - b.Eval(x, theta_rad).phi_mm);
    if (mm > largest.mm) largest = {mm, x};
  }
  return largest;
}

// |tau_a / tau_b - 1|; nothing where one of the edges does not cross the axis.
std::optional<double> TorqueRatioAt(const BladeCurve& a, const BladeCurve& b, double theta_rad) {
  const std::optional<double> torque_a = ThinPlateTorque(a, theta_rad);
  const std::optional<double> torque_b = ThinPlateTorque(b, theta_rad);
  if (!torque_a || !torque_b) return std::nullopt;
  return std::abs(*torque_a / *torque_b - 1);
}

}  // namespace

// phi_theta/phi_x at the crack tip of a thin plate: the last place where the edge crosses the axis
// rising.
std::optional<double> ThinPlateTorque(const BladeCurve& curve, double theta_rad) {
  constexpr size_t kMost = 8;
  std::array<double, kMost> contacts{};
  const int found = curve.Contacts(0, theta_rad, contacts);
  for (int i = std::min(found, static_cast<int>(kMost)) - 1; i >= 0; --i) {
    const CurveSample s = curve.Eval(contacts[i], theta_rad);
    // Of several crossings the last: the crack has passed the others.
    if (s.phi_x > 0 && s.phi_theta_mm_per_rad > 0) return s.phi_theta_mm_per_rad / s.phi_x;
  }
  return std::nullopt;
}

FamilyDifference CompareFamilies(const BladeCurve& a,
                                 const BladeCurve& b,
                                 const std::vector<double>& photographed_rad) {
  FamilyDifference difference;
  const CurveDomain& domain = a.domain();
  bool closing_found = false;
  for (int i = 0; i < kAngles; ++i) {
    const double theta = At(domain.theta_min_rad, domain.theta_max_rad, i, kAngles);
    const PlaceOfDifference place = LargestAt(a, b, theta);
    if (place.mm > difference.largest_mm) {
      difference.largest_mm = place.mm;
      difference.at_x_mm = place.x_mm;
      difference.at_theta_rad = theta;
    }
    const std::optional<double> torque = TorqueRatioAt(a, b, theta);
    if (!torque) continue;
    if (!closing_found && theta >= kNearClosing) {
      difference.near_closing_mm = place.mm;
      difference.near_closing_torque = *torque;
      difference.near_closing_theta_rad = theta;
      closing_found = true;
    }
    if (*torque <= difference.largest_torque) continue;
    difference.largest_torque = *torque;
    difference.torque_at_theta_rad = theta;
  }
  for (const double theta : photographed_rad) {
    difference.photographed_mm = std::max(difference.photographed_mm, LargestAt(a, b, theta).mm);
    const std::optional<double> torque = TorqueRatioAt(a, b, theta);
    if (torque) difference.photographed_torque = std::fmax(difference.photographed_torque, *torque);
  }
  return difference;
}

}  // namespace bladecurve
