// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/model/logged_cuts.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "model/number_table.h"
#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

double Rounded(double value, double step) {
  return step > 0 ? std::round(value / step) * step : value;
}

// theta_rad -> torque of the plate.
using PlateTorque = std::function<double(double)>;

std::string Log(const Rig& rig, std::mt19937& random, const PlateTorque& plate_nmm) {
  std::string csv = "t_s,theta_deg,force_n\n";
  const double friction_n = rig.friction_n * (1 + rig.friction_scatter * Gauss(random));
  const double phase_deg = Uniform(random, 0, 1) * rig.rate_deg_per_s / rig.rate_hz;
  const double zero_deg = Uniform(random, -0.5, 0.5) * rig.encoder_step_deg;
  const double seconds = (rig.from_deg - rig.to_deg) / rig.rate_deg_per_s;
  for (int i = 0; i < static_cast<int>(seconds * rig.rate_hz); ++i) {
    const double t_s = i / rig.rate_hz;
    const double theta_deg = rig.from_deg - phase_deg - rig.rate_deg_per_s * t_s;
    const double rubbing_n = friction_n * (1 + 0.3 * std::cos(theta_deg * kDegree * 4));
    const double force_n =
        plate_nmm(theta_deg * kDegree) / rig.radius_mm + rubbing_n + rig.noise_n * Gauss(random);
    csv += NumberText(t_s) + ',' + NumberText(Rounded(theta_deg + zero_deg, rig.encoder_step_deg)) +
           ',' + NumberText(Rounded(force_n, rig.force_step_n)) + '\n';
  }
  return csv;
}

}  // namespace

double Gauss(std::mt19937& random) {  // Box and Muller
  const double radius = std::sqrt(-2 * std::log(1 - Uniform(random, 0, 1)));
  return radius * std::cos(Uniform(random, 0, 2 * std::numbers::pi));
}

std::string LogOfCut(const Rig& rig,
                     const BladeCurve& blade,
                     const Material& material,
                     PlateSpan span,
                     std::mt19937& random,
                     const Fluctuation& fluctuation) {
  TorqueOptions options;
  options.fluctuation = fluctuation;
  TorqueModel model(blade, material, span, options);
  return Log(rig, random, [&](double theta_rad) {
    return model.Step(theta_rad, 0, 1 / rig.rate_hz).torque_nmm;
  });
}

std::string LogOfEmptyRun(const Rig& rig, std::mt19937& random) {
  return Log(rig, random, [](double) { return 0.0; });
}

}  // namespace bladecurve
