// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_curve.h"

#include <utility>

#include "model/kernel_contacts.h"
#include "model/kernel_phi.h"
#include "model/prepared_blade.h"

namespace bladecurve {

static_assert(kCurveXOutside == BLADECURVE_X_OUTSIDE &&
                  kCurveThetaOutside == BLADECURVE_THETA_OUTSIDE &&
                  kCurveNotFinite == BLADECURVE_NOT_FINITE &&
                  kCurveNotGraph == BLADECURVE_NOT_GRAPH,
              "the flags of the library and of the plugin are the same");

namespace {

CurveSample SampleOf(const bladecurve_sample& s) noexcept {
  return {s.phi_mm,
          s.phi_x,
          s.phi_theta_mm_per_rad,
          s.phi_xx_per_mm,
          s.phi_xtheta_per_rad,
          s.phi_thetatheta_mm_per_rad2,
          s.flags};
}

// A function of its own, so that what it needs of registers and stack costs a tapered rectangle
// nothing.
[[gnu::noinline]] CurveSample EvalAny(const BladeKernel& kernel,
                                      double x_mm,
                                      double theta_rad) noexcept {
  bladecurve_sample s;
  EvalBlade(&kernel, x_mm, theta_rad, &s);
  return SampleOf(s);
}

}  // namespace

BladeCurve::BladeCurve(BladeShape shape, CurveDomain domain)
    : shape_(std::move(shape)), domain_(domain), prepared_(PrepareBlade(shape_, domain_)) {}

CurveSample BladeCurve::Eval(double x_mm, double theta_rad) const noexcept {
  const BladeKernel& k = prepared_->kernel;
  if (k.is_spline == 0 && IsInside(&k, x_mm, theta_rad)) {
    bladecurve_sample s;
    Fill(&s, TaperedJet(&k, x_mm, theta_rad), 0u);
    return SampleOf(s);
  }
  return EvalAny(k, x_mm, theta_rad);
}

double BladeCurve::Phi(double x_mm, double theta_rad) const noexcept {
  const BladeKernel& k = prepared_->kernel;
  if (k.is_spline == 0 && IsInside(&k, x_mm, theta_rad)) return TaperedJet(&k, x_mm, theta_rad).f;
  return EvalAny(k, x_mm, theta_rad).phi_mm;
}

int BladeCurve::Contacts(double y_mm, double theta_rad, std::span<double> x_mm) const noexcept {
  return BladeContacts(
      &prepared_->kernel, y_mm, theta_rad, x_mm.data(), static_cast<int>(x_mm.size()));
}

}  // namespace bladecurve
