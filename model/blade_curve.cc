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

BladeCurve::BladeCurve(BladeShape shape, CurveDomain domain)
    : shape_(std::move(shape)), domain_(domain), prepared_(PrepareBlade(shape_, domain_)) {}

CurveSample BladeCurve::Eval(double x_mm, double theta_rad) const noexcept {
  bladecurve_sample s;
  EvalBlade(&prepared_->kernel, x_mm, theta_rad, &s);
  return {s.phi_mm,
          s.phi_x,
          s.phi_theta_mm_per_rad,
          s.phi_xx_per_mm,
          s.phi_xtheta_per_rad,
          s.phi_thetatheta_mm_per_rad2,
          s.flags};
}

int BladeCurve::Contacts(double y_mm, double theta_rad, std::span<double> x_mm) const noexcept {
  return BladeContacts(
      &prepared_->kernel, y_mm, theta_rad, x_mm.data(), static_cast<int>(x_mm.size()));
}

}  // namespace bladecurve
