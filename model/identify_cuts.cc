// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/identify_cuts.h"

#include <algorithm>
#include <cmath>

#include "model/blade_uncertainty.h"
#include "model/degrees.h"
#include "model/friction.h"
#include "model/number_table.h"

namespace bladecurve {
namespace {

constexpr std::size_t kFrictionBins = 200;  // a tenth of a degree each: nicks of a blade are wider
constexpr double kFreeEnds_rad = 0.1 / kDegPerRad;  // that the empty runs need not reach

// Mean torque of one empty run in each bin of angle; NaN where it has no row.
std::vector<double> BinnedTorque(const ForceLog& log, double low_rad, double width_rad) {
  std::vector<double> sum(kFrictionBins, 0), count(kFrictionBins, 0);
  for (std::size_t i = 0; i < log.theta_rad.size(); ++i) {
    const double place = (log.theta_rad[i] - low_rad) / width_rad;
    if (place < 0 || place >= static_cast<double>(kFrictionBins)) continue;
    sum[static_cast<std::size_t>(place)] += log.torque_nmm[i];
    ++count[static_cast<std::size_t>(place)];
  }
  for (std::size_t b = 0; b < kFrictionBins; ++b) sum[b] /= count[b];
  return sum;
}

// Mean of the empty runs over the angles they share; torques in the place of forces.
FrictionCurve MeanFriction(const std::vector<const ForceLog*>& empties) {
  double low_rad = -HUGE_VAL, high_rad = HUGE_VAL;
  for (const ForceLog* log : empties) {
    const auto [least, most] = std::minmax_element(log->theta_rad.begin(), log->theta_rad.end());
    low_rad = std::max(low_rad, *least);
    high_rad = std::min(high_rad, *most);
    if (low_rad >= high_rad)
      throw LogRefused("too_short", log->source + ": shares no angle with the other empty runs");
  }
  const double width_rad = (high_rad - low_rad) / kFrictionBins;
  std::vector<double> mean(kFrictionBins, 0);
  for (const ForceLog* log : empties) {
    const std::vector<double> binned = BinnedTorque(*log, low_rad, width_rad);
    for (std::size_t b = 0; b < kFrictionBins; ++b)
      mean[b] += binned[b] / static_cast<double>(empties.size());
  }
  std::vector<double> theta_rad, torque_nmm;
  for (std::size_t b = 0; b < kFrictionBins; ++b) {
    if (std::isnan(mean[b])) continue;
    theta_rad.push_back(low_rad + (static_cast<double>(b) + 0.5) * width_rad);
    torque_nmm.push_back(mean[b]);
  }
  return {theta_rad, torque_nmm, torque_nmm};
}

PlateLog LessFriction(const ForceLog& cut, const FrictionCurve& friction) {
  PlateLog plate{cut.source, cut.theta_rad, cut.torque_nmm};
  for (std::size_t i = 0; i < plate.theta_rad.size(); ++i)
    plate.torque_nmm[i] -= friction.Closing(plate.theta_rad[i]);
  return plate;
}

// Area under the torque, by the trapezoidal rule, from one angle down to another.
double WorkBetween(const PlateLog& log, double from_rad, double to_rad) {
  const auto first_below = [&log](double angle_rad) {
    const auto found = std::find_if(log.theta_rad.begin(),
                                    log.theta_rad.end() - 1,
                                    [angle_rad](double theta) { return theta <= angle_rad; });
    return static_cast<std::size_t>(found - log.theta_rad.begin());
  };
  const std::size_t first = first_below(from_rad), last = first_below(to_rad);
  double work_nmm = log.torque_nmm[first] * (from_rad - log.theta_rad[first]);
  for (std::size_t i = first + 1; i <= last; ++i) {
    work_nmm += 0.5 * (log.torque_nmm[i - 1] + log.torque_nmm[i]) *
                (log.theta_rad[i - 1] - log.theta_rad[i]);
  }
  return work_nmm;
}

IdentifiedCut IdentifyCut(const PlateLog& log, const CutScene& scene) {
  IdentifiedCut cut{log.source, FindCutPhases(log, scene)};
  const CutPhases& phases = cut.phases;
  const double delta_mm = phases.contact_offset_mm + phases.deflection_mm;
  cut.length_by_phi_mm = MeetingPoint(scene, delta_mm, phases.end_rad) - scene.span.edge_mm;
  cut.length_mm = phases.through ? scene.span.end_mm - scene.span.edge_mm : cut.length_by_phi_mm;
  cut.toughness_n_per_mm =
      WorkBetween(log, phases.start_rad, phases.end_rad) / (scene.thickness_mm * cut.length_mm);
  if (cut.toughness_n_per_mm > 0) return cut;
  throw LogRefused("no_cut", log.source + ": the work of cutting is not positive; check the blade");
}

std::string DegreesText(double angle_rad) {
  return NumberText(std::round(angle_rad * kDegPerRad * 100) / 100);
}

// The angle at which the blade meets the edge of the plate.
double ContactAngle(const IdentifyInput& input) {
  const BladeCurve& blade = input.blade.curve;
  double low = blade.domain().theta_min_rad, high = blade.domain().theta_max_rad;
  for (int i = 0; i < 30; ++i) {  // to a billionth: uncertainties need not even that
    const double middle = 0.5 * (low + high);
    const bool touches = blade.Phi(input.span.edge_mm, middle) < 0.5 * input.thickness_mm;
    (touches ? low : high) = middle;
  }
  return low;
}

// Standard uncertainty of the plate's deflection at its edge: of phi's covariance, and of an
// encoder that may read half a step too much.
double ContactSigma(const IdentifyInput& input, double step_rad) {
  const double x_mm = input.span.edge_mm, theta_rad = ContactAngle(input);
  const double of_encoder_mm =
      0.5 * step_rad * input.blade.curve.Eval(x_mm, theta_rad).phi_theta_mm_per_rad;
  const auto edge = [=](const BladeCurve& blade) {
    return std::vector{blade.Phi(x_mm, theta_rad)};
  };
  return std::hypot(of_encoder_mm, PropagateBladeUncertainty(input.blade, edge)[0]);
}

// Rejects empty runs that leave a part of the cut's friction unknown.
void RequireCovered(const std::vector<const ForceLog*>& empties,
                    const std::string& cut,
                    double from_rad,
                    double to_rad) {
  for (const ForceLog* log : empties) {
    const auto [least, most] = std::minmax_element(log->theta_rad.begin(), log->theta_rad.end());
    if (*least <= to_rad + kFreeEnds_rad && *most >= from_rad - kFreeEnds_rad) continue;
    throw LogRefused("too_short",
                     log->source + ": the empty run goes from " + DegreesText(*most) + " to " +
                         DegreesText(*least) + " deg; the cut " + cut + " needs friction from " +
                         DegreesText(from_rad) + " to " + DegreesText(to_rad) + " deg");
  }
}

}  // namespace

std::vector<IdentifiedCut> IdentifyCuts(const IdentifyInput& input,
                                        const std::vector<const ForceLog*>& empties,
                                        const BladeCurve& blade) {
  CutScene scene{blade, input.span, input.thickness_mm};
  const FrictionCurve friction = MeanFriction(empties);
  std::vector<IdentifiedCut> cuts;
  for (const ForceLog& log : input.cuts) {
    const double contact_rad = std::min(ContactAngle(input), log.theta_rad.front());
    RequireCovered(empties, log.source, contact_rad, contact_rad);
    scene.contact_sigma_mm = ContactSigma(input, log.step_rad);
    cuts.push_back(IdentifyCut(LessFriction(log, friction), scene));
    const CutPhases& phases = cuts.back().phases;
    RequireCovered(empties, log.source, phases.contact_rad, phases.end_rad);
  }
  return cuts;
}

}  // namespace bladecurve
