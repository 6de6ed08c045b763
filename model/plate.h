// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace bladecurve {

// Force and its slope at one deflection.
struct ForceSample {
  double force_n = 0;
  double stiffness_n_per_mm = 0;
};

// g(delta), the force that holds the upper edge of the crack tip displaced by delta (eq. 1).
// Invariant: g(0) = 0, strictly increasing, C1, everywhere defined: it goes on linearly below zero
// (where no force acts, but events are sought) and beyond the last measured deflection.
class ForceDeflection {
 public:
  // g = k delta (eq. 22). Throws std::invalid_argument unless k is positive and finite.
  explicit ForceDeflection(double stiffness_n_per_mm);

  // Through measured points, by the monotone cubic of Fritsch and Carlson (1980). Both ascending,
  // from (0, 0). Throws std::invalid_argument for fewer than two points or points that do not
  // ascend.
  ForceDeflection(std::vector<double> delta_mm, std::vector<double> force_n);

  // Real-time safe: noexcept, no allocation, O(log points).
  [[nodiscard]] ForceSample Eval(double delta_mm) const noexcept;

  [[nodiscard]] bool linear() const noexcept { return delta_mm_.empty(); }
  [[nodiscard]] double initial_stiffness_n_per_mm() const noexcept { return initial_stiffness_; }
  [[nodiscard]] const std::vector<double>& delta_mm() const noexcept { return delta_mm_; }
  [[nodiscard]] const std::vector<double>& force_n() const noexcept { return force_n_; }

 private:
  double initial_stiffness_;
  std::vector<double> delta_mm_, force_n_, slope_n_per_mm_;  // empty: linear
};

// What is cut.
struct Material {
  std::string name;
  double toughness_n_per_mm = 0;  // J_c; the same number in kJ/m^2
  double thickness_mm = 0;        // h
  ForceDeflection force_deflection{1.0};
};

// Where it lies: along the x axis, between these distances from the pivot's first position.
struct PlateSpan {
  double edge_mm = 0;
  double end_mm = 0;
};

// Throws std::invalid_argument, naming field, value and bound, for a material that cannot be one.
void CheckMaterial(const Material& material);

// The same for a span: finite, edge before end.
void CheckPlateSpan(const PlateSpan& span);

}  // namespace bladecurve
