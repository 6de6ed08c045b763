// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/friction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "model/degrees.h"

namespace bladecurve {

FrictionCurve::FrictionCurve(std::vector<double> theta_rad,
                             std::vector<double> closing_n,
                             std::vector<double> opening_n)
    : theta_rad_(std::move(theta_rad)),
      closing_n_(std::move(closing_n)),
      opening_n_(std::move(opening_n)) {
  if (theta_rad_.empty() || closing_n_.size() != theta_rad_.size() ||
      opening_n_.size() != theta_rad_.size()) {
    throw std::invalid_argument("friction: needs one angle or more, and as many forces each way");
  }
  for (std::size_t i = 1; i < theta_rad_.size(); ++i) {
    if (theta_rad_[i] > theta_rad_[i - 1]) continue;
    throw std::invalid_argument("friction: angle " + std::to_string(i) + " does not ascend");
  }
}

double FrictionCurve::Closing(double theta_rad) const noexcept {
  return Interpolate(closing_n_, theta_rad);
}
double FrictionCurve::Opening(double theta_rad) const noexcept {
  return Interpolate(opening_n_, theta_rad);
}

double FrictionCurve::Interpolate(const std::vector<double>& force_n,
                                  double theta_rad) const noexcept {
  const auto upper = std::upper_bound(theta_rad_.begin(), theta_rad_.end(), theta_rad);
  if (upper == theta_rad_.begin()) return force_n.front();
  if (upper == theta_rad_.end()) return force_n.back();
  const auto i = static_cast<std::size_t>(upper - theta_rad_.begin()) - 1;
  const double t = (theta_rad - theta_rad_[i]) / (theta_rad_[i + 1] - theta_rad_[i]);
  return force_n[i] + t * (force_n[i + 1] - force_n[i]);
}

FrictionCurve FrictionOfTable(const NumberTable& table) {
  std::vector<double> theta_rad = table.Get("theta_deg");
  std::vector<double> closing_n = table.Get("closing_n");
  const std::vector<double>* measured = table.Find("opening_n");
  std::vector<double> opening_n = measured ? *measured : closing_n;
  if (!measured)
    std::transform(opening_n.begin(), opening_n.end(), opening_n.begin(), std::negate<>());
  for (double& angle : theta_rad) angle *= kRadPerDeg;
  if (theta_rad.front() > theta_rad.back()) {
    std::reverse(theta_rad.begin(), theta_rad.end());
    std::reverse(closing_n.begin(), closing_n.end());
    std::reverse(opening_n.begin(), opening_n.end());
  }
  try {
    return {std::move(theta_rad), std::move(closing_n), std::move(opening_n)};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(table.source + ": " + error.what() +
                                "; sort the rows by theta_deg");
  }
}

StickSlide::StickSlide(double z_max_mm) : z_max_mm_(z_max_mm) {
  if (std::isfinite(z_max_mm) && z_max_mm > 0) return;
  throw std::invalid_argument("friction: z_max is " + std::to_string(z_max_mm) +
                              " mm, must be positive and finite");
}

double StickSlide::Step(double x_mm, double coulomb_n) noexcept {
  if (!std::isfinite(x_mm) || !std::isfinite(coulomb_n)) return force_n_;
  if (!started_) contact_mm_ = x_mm;
  started_ = true;
  const double stretch_mm = x_mm - contact_mm_;  // z_k
  if (std::abs(stretch_mm) > z_max_mm_) contact_mm_ = x_mm - std::copysign(z_max_mm_, stretch_mm);
  force_n_ = std::max(coulomb_n, 0.0) / z_max_mm_ * (x_mm - contact_mm_);
  return force_n_;
}

void StickSlide::Reset() noexcept {
  contact_mm_ = 0;
  force_n_ = 0;
  started_ = false;
}

}  // namespace bladecurve
