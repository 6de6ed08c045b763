// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/crack_tip.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// An edge flatter than this against the plate squeezes and does not shear: the torque of eq. (15)
// would pass a million times that of a usual blade.
constexpr double kLeastSlope = 1e-7;
// An edge turned this far from the centre line of its blade (89.4 deg) is no scissor blade.
constexpr double kLeastCosAlpha = 0.01;
// The edge rounds off into the tip: the force fades over this length beyond the end of the measured
// edge.
constexpr double kFade_mm = 1.0;
// Value of the cutting level where the blade cannot cut: below any force difference that can occur.
constexpr double kNeverCuts_n = -1e300;

// 1 up to `end`, 0 from end + kFade_mm on, C1 between.
double OnBlade(double x_mm, double end_mm) {
  const double t = std::clamp((x_mm - end_mm) / kFade_mm, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

// tau_c, the force it stands for and their derivatives, by logarithmic differentiation.
void FillCutting(double resistance_n, double sin_alpha, CrackTip& tip) {
  const CurveSample& e = tip.edge;
  const double of_phi_x = 1 / e.phi_x;
  const double of_phi_theta = 1 / e.phi_theta_mm_per_rad;
  const double torque_x = e.phi_xtheta_per_rad * of_phi_theta - e.phi_xx_per_mm * of_phi_x;
  const double torque_theta =
      e.phi_thetatheta_mm_per_rad2 * of_phi_theta - e.phi_xtheta_per_rad * of_phi_x;
  tip.cut_torque_nmm = resistance_n * e.phi_theta_mm_per_rad * of_phi_x;
  tip.cut_torque_x_n = tip.cut_torque_nmm * torque_x;
  tip.cut_torque_theta_nmm = tip.cut_torque_nmm * torque_theta;

  const double turn = 1 / (1 + e.phi_x * e.phi_x);  // d atan(phi_x) / d phi_x
  const double tan_alpha = sin_alpha / tip.cos_alpha;
  const double lever_x = 1 / tip.x_mm + tan_alpha * e.phi_xx_per_mm * turn;
  const double lever_theta = -tan_alpha * (0.5 - e.phi_xtheta_per_rad * turn);
  tip.cut_force_n = tip.cut_torque_nmm / (tip.x_mm * tip.cos_alpha);
  tip.cut_force_x_n_per_mm = tip.cut_force_n * (torque_x - lever_x);
  tip.cut_force_theta_n = tip.cut_force_n * (torque_theta - lever_theta);
}

}  // namespace

CrackTip EvalCrackTip(const BladeCurve& blade,
                      const Material& material,
                      double x_mm,
                      double theta_rad) noexcept {
  CrackTip tip;
  tip.x_mm = x_mm;
  tip.theta_rad = theta_rad;
  tip.edge = blade.Eval(x_mm, theta_rad);
  const double half_sin = std::sin(0.5 * theta_rad);
  const double half_cos = std::cos(0.5 * theta_rad);
  const double cos_slope = 1 / std::sqrt(1 + tip.edge.phi_x * tip.edge.phi_x);
  const double sin_alpha = (half_sin - half_cos * tip.edge.phi_x) * cos_slope;
  tip.delta_mm = 0.5 * material.thickness_mm - tip.edge.phi_mm;
  tip.cos_alpha = (half_cos + half_sin * tip.edge.phi_x) * cos_slope;
  tip.sin_slope = tip.edge.phi_x * cos_slope;
  tip.on_blade = OnBlade(x_mm, blade.domain().x_max_mm);
  tip.can_cut = x_mm > 0 && tip.on_blade > 0 && tip.edge.phi_x > kLeastSlope &&
                tip.edge.phi_theta_mm_per_rad > 0 && tip.cos_alpha > kLeastCosAlpha &&
                (tip.edge.flags & (kCurveNotFinite | kCurveNotGraph)) == 0;
  if (tip.can_cut) FillCutting(material.toughness_n_per_mm * material.thickness_mm, sin_alpha, tip);
  return tip;
}

Level CuttingLevel(const CrackTip& tip, const Material& material) noexcept {
  if (!tip.can_cut) return {kNeverCuts_n, 0, 0};
  const ForceSample g = material.force_deflection.Eval(tip.delta_mm);
  return {g.force_n - tip.cut_force_n,
          -g.stiffness_n_per_mm * tip.edge.phi_x - tip.cut_force_x_n_per_mm,
          -g.stiffness_n_per_mm * tip.edge.phi_theta_mm_per_rad - tip.cut_force_theta_n};
}

double ElasticTorque(const CrackTip& tip, const Material& material) noexcept {
  if (tip.delta_mm <= 0 || tip.x_mm <= 0) return 0;
  const double force_n = material.force_deflection.Eval(tip.delta_mm).force_n;
  return tip.on_blade * tip.x_mm * force_n * std::max(tip.cos_alpha, 0.0);
}

}  // namespace bladecurve
