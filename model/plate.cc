// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/plate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bladecurve {
namespace {

[[noreturn]] void Fail(const std::string& what, double value, const std::string& bound) {
  throw std::invalid_argument("plate: " + what + " is " + std::to_string(value) + ", must be " +
                              bound);
}

void RequirePositive(const std::string& what, double value) {
  if (!std::isfinite(value) || value <= 0) Fail(what, value, "positive and finite");
}

void RequireAscendingFromZero(const std::string& what, const std::vector<double>& values) {
  if (values.front() != 0) Fail(what + "[0]", values.front(), "0");
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || values[i] <= values[i - 1]) {
      Fail(what + "[" + std::to_string(i) + "]", values[i], "greater than the one before");
    }
  }
}

// Weighted harmonic mean of the neighbouring secants (Fritsch and Butland 1984): never overshoots.
double InnerSlope(double h0, double h1, double secant0, double secant1) {
  const double w0 = 2 * h1 + h0;
  const double w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / secant0 + w1 / secant1);
}

// One-sided three-point slope, not below zero: with ascending secants that keeps the cubic
// monotone.
double EndSlope(double h0, double h1, double secant0, double secant1) {
  return std::max(0.0, ((2 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1));
}

std::vector<double> MonotoneSlopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> h(n - 1), secant(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = x[i + 1] - x[i];
    secant[i] = (y[i + 1] - y[i]) / h[i];
  }
  if (n == 2) return {secant[0], secant[0]};
  slope[0] = EndSlope(h[0], h[1], secant[0], secant[1]);
  for (std::size_t i = 1; i + 1 < n; ++i)
    slope[i] = InnerSlope(h[i - 1], h[i], secant[i - 1], secant[i]);
  slope[n - 1] = EndSlope(h[n - 2], h[n - 3], secant[n - 2], secant[n - 3]);
  return slope;
}

}  // namespace

ForceDeflection::ForceDeflection(double stiffness_n_per_mm)
    : initial_stiffness_(stiffness_n_per_mm) {
  RequirePositive("stiffness k", stiffness_n_per_mm);
}

ForceDeflection::ForceDeflection(std::vector<double> delta_mm, std::vector<double> force_n)
    : initial_stiffness_(0), delta_mm_(std::move(delta_mm)), force_n_(std::move(force_n)) {
  if (delta_mm_.size() < 2 || delta_mm_.size() != force_n_.size()) {
    throw std::invalid_argument(
        "plate: force_deflection needs two or more points, as many forces as deflections");
  }
  RequireAscendingFromZero("delta_mm", delta_mm_);
  RequireAscendingFromZero("force_n", force_n_);
  slope_n_per_mm_ = MonotoneSlopes(delta_mm_, force_n_);
  initial_stiffness_ = slope_n_per_mm_.front();
}

ForceSample ForceDeflection::Eval(double delta_mm) const noexcept {
  if (linear() || delta_mm <= 0) return {initial_stiffness_ * delta_mm, initial_stiffness_};
  if (delta_mm >= delta_mm_.back()) {
    return {force_n_.back() + slope_n_per_mm_.back() * (delta_mm - delta_mm_.back()),
            slope_n_per_mm_.back()};
  }
  const auto upper = std::upper_bound(delta_mm_.begin(), delta_mm_.end(), delta_mm);
  const auto i = static_cast<std::size_t>(upper - delta_mm_.begin()) - 1;
  const double h = delta_mm_[i + 1] - delta_mm_[i];
  const double rise = force_n_[i + 1] - force_n_[i];
  const double m0 = slope_n_per_mm_[i] * h;
  const double m1 = slope_n_per_mm_[i + 1] * h;
  const double t = (delta_mm - delta_mm_[i]) / h;
  const double c2 = 3 * rise - 2 * m0 - m1;  // the Hermite cubic y0 + m0 t + c2 t^2 + c3 t^3
  const double c3 = m0 + m1 - 2 * rise;
  return {force_n_[i] + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2 * c2 + 3 * t * c3)) / h};
}

void CheckMaterial(const Material& material) {
  RequirePositive("toughness J_c", material.toughness_n_per_mm);
  RequirePositive("thickness h", material.thickness_mm);
}

void CheckPlateSpan(const PlateSpan& span) {
  if (!std::isfinite(span.edge_mm)) Fail("x_edge", span.edge_mm, "finite");
  if (!std::isfinite(span.end_mm) || span.end_mm <= span.edge_mm)
    Fail("x_end", span.end_mm, "beyond x_edge");
}

}  // namespace bladecurve
