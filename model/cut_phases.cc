// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/cut_phases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "model/deformation_ramp.h"
#include "model/force_log.h"

namespace bladecurve {
namespace {

// The log in this many bins, to see its phases: a thirtieth of a degree each in a usual one.
constexpr std::size_t kBins = 800;
// Shares of the cut's resistance: where the plate begins to be felt, is felt half and in full. Half
// way is far from noise and from waves of the cut; the others are as far as they may be from it.
constexpr double kBegun = 0.2, kHalf = 0.5, kDone = 0.8;
// Rejects logs without a cut: its resistance must be this many times what there is before it.
constexpr double kClear = 2;
constexpr int kFewestRows = 5;       // of the deformation: for a slope and both its ends
constexpr double kLine_mm = 1.0;     // a straight line follows the beginning of a cut this far
constexpr std::size_t kEndBins = 3;  // that must lie beyond the end of a plate: fewer may be noise

// The blade as the plate's edge sees it.
struct EdgeView {
  double delta_mm = 0;  // h/2 - phi
  double lever_mm = 0;  // x cos(alpha)
  double slope = 0;     // phi_x
};

EdgeView ViewAt(const CutScene& scene, double theta_rad) {
  const double x_mm = scene.span.edge_mm;
  const CurveSample edge = scene.blade.Eval(x_mm, theta_rad);
  return {0.5 * scene.thickness_mm - edge.phi_mm,
          x_mm * std::cos(0.5 * theta_rad - std::atan(edge.phi_x)),
          edge.phi_x};
}

// Means of as many rows each.
PlateLog Binned(const PlateLog& log) {
  const std::size_t n = log.theta_rad.size();
  const std::size_t bins = std::min(kBins, n);
  PlateLog binned{log.source, std::vector<double>(bins), std::vector<double>(bins)};
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t begin = b * n / bins, end = (b + 1) * n / bins;
    const double share = 1 / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      binned.theta_rad[b] += share * log.theta_rad[i];
      binned.torque_nmm[b] += share * log.torque_nmm[i];
    }
  }
  return binned;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// torque phi_x/phi_theta where the blade meets the plate: J_c h while cutting (15), whatever the
// angle.
struct Resistance {
  std::vector<double> value_n;
  double of_cut_n = 0;  // median while the blade passes the plate
};

[[noreturn]] void RefuseLateBeginning(const std::string& source) {
  throw LogRefused(
      "too_short",
      source + ": begins when the blade already touches the plate; log from wider open");
}

Resistance ResistanceOf(const PlateLog& bins, const CutScene& scene) {
  Resistance resistance;
  std::vector<double> before, passing;
  for (std::size_t i = 0; i < bins.theta_rad.size(); ++i) {
    const double meeting_mm = MeetingPoint(scene, 0, bins.theta_rad[i]);
    const double x_mm = std::clamp(meeting_mm, scene.span.edge_mm, scene.span.end_mm);
    const CurveSample edge = scene.blade.Eval(x_mm, bins.theta_rad[i]);
    const bool cuts = edge.phi_x > 0 && edge.phi_theta_mm_per_rad > 0;
    const double value_n = cuts ? bins.torque_nmm[i] * edge.phi_x / edge.phi_theta_mm_per_rad : 0;
    resistance.value_n.push_back(value_n);
    if (x_mm == meeting_mm) passing.push_back(value_n);
    if (x_mm > meeting_mm) before.push_back(std::abs(value_n));
  }
  if (before.empty()) RefuseLateBeginning(bins.source);
  resistance.of_cut_n = Median(passing);
  if (resistance.of_cut_n > kClear * Median(before)) return resistance;
  throw LogRefused(
      "no_cut",
      bins.source +
          ": no cut stands out of the friction while the blade passes the plate; check "
          "where the plate lies, the blade, and that resistance counts positive");
}

// The bins in which the cut begins, is half begun, is in full, and the last one of it.
struct Landmarks {
  std::size_t begun = 0, half = 0, done = 0, last = 0;
};

Landmarks FindLandmarks(const Resistance& resistance, const std::string& source) {
  const std::vector<double>& value_n = resistance.value_n;
  const std::size_t n = value_n.size();
  const auto is_above = [&](std::size_t i, double share) {
    return i < n && value_n[i] >= share * resistance.of_cut_n;
  };
  Landmarks bins;
  while (bins.half < n && !(is_above(bins.half, kHalf) && is_above(bins.half + 1, kHalf)))
    ++bins.half;
  bins.begun = bins.done = std::min(bins.half, n - 1);
  while (bins.begun > 0 && is_above(bins.begun, kBegun)) --bins.begun;
  while (bins.done + 1 < n && !is_above(bins.done, kDone)) ++bins.done;
  bins.last = n - 1;
  while (bins.last > bins.done && !is_above(bins.last, kHalf)) --bins.last;
  if (bins.begun == 0) RefuseLateBeginning(source);
  if (bins.last <= bins.done) {
    throw LogRefused("too_short",
                     source + ": ends before the plate is cut; log until the blades close");
  }
  return bins;
}

// The rows about the beginning of the cut.
std::vector<DeformationRow> RowsWithin(const PlateLog& log,
                                       const CutScene& scene,
                                       double middle_mm,
                                       double reach_mm) {
  std::vector<DeformationRow> rows;
  for (std::size_t i = 0; i < log.theta_rad.size(); ++i) {
    const EdgeView view = ViewAt(scene, log.theta_rad[i]);
    if (std::abs(view.delta_mm - middle_mm) <= reach_mm)
      rows.push_back({view.delta_mm, log.torque_nmm[i] / view.lever_mm});
  }
  return rows;
}

// Whether contact is where phi has it, as far as log and phi can tell. Both bends of a ramp are
// independent but for their rows: the variance of one is 4 noise^2/(rows k^2).
bool AgreesWithPhi(const DeformationRamp& ramp, double contact_sigma_mm) {
  constexpr double kLargestDeviation = 3;  // standard deviations: rejects a phi that is off
  const double of_log_mm = 2 * ramp.noise_n / (ramp.stiffness_n_per_mm * std::sqrt(ramp.rows));
  return std::abs(ramp.contact_mm) <= kLargestDeviation * std::hypot(of_log_mm, contact_sigma_mm);
}

DeformationRamp FitBeginning(const PlateLog& log,
                             const PlateLog& bins,
                             const Landmarks& at,
                             const CutScene& scene) {
  const EdgeView half = ViewAt(scene, bins.theta_rad[at.half]);
  const double rise_mm = ViewAt(scene, bins.theta_rad[at.done]).delta_mm -
                         ViewAt(scene, bins.theta_rad[at.begun]).delta_mm;
  RampSearch search{half.delta_mm, rise_mm / (kDone - kBegun)};
  const std::vector<DeformationRow> rows =
      RowsWithin(log, scene, half.delta_mm, std::max(2.5 * search.width_mm, half.slope * kLine_mm));
  DeformationRamp ramp = FitDeformationRamp(rows, search);
  if (AgreesWithPhi(ramp, scene.contact_sigma_mm)) {
    search.contact_weight = std::pow(ramp.noise_n / scene.contact_sigma_mm, 2);
    ramp = FitDeformationRamp(rows, search);
  }
  if (ramp.rows >= kFewestRows) return ramp;
  throw LogRefused("too_short",
                   log.source + ": " + std::to_string(ramp.rows) +
                       " rows between contact and cut; log faster or close slower");
}

// The angle at which the plate's edge has this deflection: phi grows with theta.
double AngleOfDeflection(const PlateLog& log, const CutScene& scene, double delta_mm) {
  double low = log.theta_rad.back(), high = log.theta_rad.front();
  for (int i = 0; i < 60; ++i) {  // to the last bit
    const double middle = 0.5 * (low + high);
    (ViewAt(scene, middle).delta_mm > delta_mm ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double MeetingPoint(const CutScene& scene, double delta_mm, double theta_rad) noexcept {
  const double y_mm = 0.5 * scene.thickness_mm - delta_mm;
  const CurveDomain& domain = scene.blade.domain();
  std::array<double, 1> x_mm;
  if (scene.blade.Contacts(y_mm, theta_rad, x_mm) > 0) return x_mm[0];
  return scene.blade.Phi(domain.x_max_mm, theta_rad) < y_mm ? domain.x_max_mm : domain.x_min_mm;
}

CutPhases FindCutPhases(const PlateLog& log, const CutScene& scene) {
  const PlateLog bins = Binned(log);
  const Landmarks at = FindLandmarks(ResistanceOf(bins, scene), log.source);
  const DeformationRamp ramp = FitBeginning(log, bins, at, scene);
  CutPhases phases;
  phases.contact_offset_mm = ramp.contact_mm;
  phases.deflection_mm = ramp.width_mm;
  phases.stiffness_n_per_mm = ramp.stiffness_n_per_mm;
  phases.contact_rad = AngleOfDeflection(log, scene, ramp.contact_mm);
  phases.start_rad = AngleOfDeflection(log, scene, ramp.contact_mm + ramp.width_mm);
  phases.through = at.last + kEndBins < bins.theta_rad.size();
  phases.end_rad = phases.through ? bins.theta_rad[at.last + 1] : log.theta_rad.back();
  return phases;
}

}  // namespace bladecurve
