// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/identify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "model/blade_uncertainty.h"
#include "model/identify_cuts.h"

namespace bladecurve {
namespace {

constexpr double kLargestMismatch = 0.05;  // of the cut's length, and so of J_c
constexpr double kLargestOffset_mm = 0.5;  // several times what a good fit of phi leaves
// What the straight line after the start of a cut, and bins, leave of J_c and k without any noise.
constexpr double kMethodToughness = 2e-4, kMethodStiffness = 3e-3;

// J_c and k.
struct Values {
  double toughness_n_per_mm = 0, stiffness_n_per_mm = 0;
};

struct Mean {
  double value = 0, deviation = std::numeric_limits<double>::quiet_NaN();
};

Mean MeanOf(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Mean mean;
  for (const double value : values) mean.value += value / n;
  if (values.size() < 2) return mean;
  double squares = 0;
  for (const double value : values) squares += (value - mean.value) * (value - mean.value);
  mean.deviation = std::sqrt(squares / (n - 1));
  return mean;
}

// Half of Student's t at 97.5 %: what makes +-2 of a standard error hold 95 % with so few degrees
// of freedom. Beyond the table by the expansion of Cornish and Fisher, to 1e-4.
double StudentHalf(std::size_t degrees) {
  constexpr std::array kHalves = {
      6.3531, 2.1513, 1.5912, 1.3882, 1.2853, 1.2234, 1.1823, 1.1530, 1.1311, 1.1141};
  if (degrees <= kHalves.size()) return kHalves[degrees - 1];
  constexpr double kZ = 1.959964;
  const auto v = static_cast<double>(degrees);
  const double z3 = kZ * kZ * kZ;
  return 0.5 * (kZ + (z3 + kZ) / (4 * v) + (5 * z3 * kZ * kZ + 16 * z3 + 3 * kZ) / (96 * v * v));
}

Values MeanValues(const std::vector<IdentifiedCut>& cuts) {
  Values mean;
  for (const IdentifiedCut& cut : cuts) {
    mean.toughness_n_per_mm += cut.toughness_n_per_mm / static_cast<double>(cuts.size());
    mean.stiffness_n_per_mm += cut.phases.stiffness_n_per_mm / static_cast<double>(cuts.size());
  }
  return mean;
}

std::vector<const ForceLog*> AllOf(const std::vector<ForceLog>& logs) {
  std::vector<const ForceLog*> all;
  all.reserve(logs.size());
  for (const ForceLog& log : logs) all.push_back(&log);
  return all;
}

// Jackknife: what leaving out one empty run after the other changes.
Values FrictionShare(const IdentifyInput& input) {
  const std::size_t n = input.empties.size();
  if (n < 2) return {};
  std::vector<double> toughness, stiffness;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<const ForceLog*> others = AllOf(input.empties);
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Values without = MeanValues(IdentifyCuts(input, others, input.blade.curve));
    toughness.push_back(without.toughness_n_per_mm);
    stiffness.push_back(without.stiffness_n_per_mm);
  }
  const double factor =
      StudentHalf(n - 1) * static_cast<double>(n - 1) / std::sqrt(static_cast<double>(n));
  return {factor * MeanOf(toughness).deviation, factor * MeanOf(stiffness).deviation};
}

// An encoder may read half a step too much in all runs alike.
Values EncoderShare(IdentifyInput input, const Values& mean) {
  for (std::vector<ForceLog>* logs : {&input.cuts, &input.empties}) {
    for (ForceLog& log : *logs) {
      for (double& angle : log.theta_rad) angle += 0.5 * log.step_rad;
    }
  }
  const Values moved = MeanValues(IdentifyCuts(input, AllOf(input.empties), input.blade.curve));
  return {std::abs(moved.toughness_n_per_mm - mean.toughness_n_per_mm),
          std::abs(moved.stiffness_n_per_mm - mean.stiffness_n_per_mm)};
}

Values BladeShare(const IdentifyInput& input) {
  const auto identify = [&input](const BladeCurve& blade) {
    const Values mean = MeanValues(IdentifyCuts(input, AllOf(input.empties), blade));
    return std::vector{mean.toughness_n_per_mm, mean.stiffness_n_per_mm};
  };
  const std::vector<double> sigmas = PropagateBladeUncertainty(input.blade, identify);
  return {sigmas[0], sigmas[1]};
}

// Standard uncertainties of a mean besides the scatter of the cuts.
struct Shares {
  double friction = 0, encoder = 0, blade = 0, method = 0;
};

Identified Join(const std::vector<double>& values, const Shares& shares) {
  const Mean mean = MeanOf(values);
  Identified identified{mean.value, mean.deviation};
  identified.from_blade = shares.blade;
  if (values.size() < 2) return identified;
  const double of_cuts = StudentHalf(values.size() - 1) * mean.deviation /
                         std::sqrt(static_cast<double>(values.size()));
  identified.uncertainty = std::hypot(std::hypot(of_cuts, shares.friction, shares.blade),
                                      shares.encoder,
                                      shares.method * mean.value);
  return identified;
}

std::vector<std::string> DoubtsOf(const IdentifyInput& input,
                                  const std::vector<IdentifiedCut>& cuts) {
  std::vector<std::string> doubts;
  if (cuts.size() < 2) doubts.emplace_back("one_cut");
  if (input.empties.size() < 2) doubts.emplace_back("one_empty_run");
  if (!KnowsBladeUncertainty(input.blade)) doubts.emplace_back("blade_uncertainty_unknown");
  const auto mismatched = [](const IdentifiedCut& cut) {
    return std::abs(cut.length_by_phi_mm - cut.length_mm) > kLargestMismatch * cut.length_mm;
  };
  const auto offset = [](const IdentifiedCut& cut) {
    return std::abs(cut.phases.contact_offset_mm) > kLargestOffset_mm;
  };
  if (std::any_of(cuts.begin(), cuts.end(), mismatched)) doubts.emplace_back("length_mismatch");
  if (std::any_of(cuts.begin(), cuts.end(), offset)) doubts.emplace_back("contact_offset");
  return doubts;
}

void RequirePossible(const IdentifyInput& input) {
  if (input.cuts.empty() || input.empties.empty())
    throw std::invalid_argument("identify: needs one cut and one empty run at least");
  if (!(std::isfinite(input.thickness_mm) && input.thickness_mm > 0))
    throw std::invalid_argument("identify: thickness is " + std::to_string(input.thickness_mm) +
                                " mm, must be positive");
  CheckPlateSpan(input.span);
  if (input.span.edge_mm <= 0)
    throw std::invalid_argument("identify: x_edge is " + std::to_string(input.span.edge_mm) +
                                " mm, must be positive");
  for (const ForceLog& log : input.cuts) RefuseSaturation(log);
}

}  // namespace

Identification IdentifyMaterial(const IdentifyInput& input) {
  RequirePossible(input);
  Identification result;
  result.cuts = IdentifyCuts(input, AllOf(input.empties), input.blade.curve);
  result.doubts = DoubtsOf(input, result.cuts);
  const Values friction = FrictionShare(input);
  const Values encoder = EncoderShare(input, MeanValues(result.cuts));
  const Values blade = BladeShare(input);
  std::vector<double> toughness, stiffness;
  for (const IdentifiedCut& cut : result.cuts) {
    toughness.push_back(cut.toughness_n_per_mm);
    stiffness.push_back(cut.phases.stiffness_n_per_mm);
  }
  result.toughness_n_per_mm = Join(toughness,
                                   {friction.toughness_n_per_mm,
                                    encoder.toughness_n_per_mm,
                                    blade.toughness_n_per_mm,
                                    kMethodToughness});
  result.stiffness_n_per_mm = Join(stiffness,
                                   {friction.stiffness_n_per_mm,
                                    encoder.stiffness_n_per_mm,
                                    blade.stiffness_n_per_mm,
                                    kMethodStiffness});
  return result;
}

}  // namespace bladecurve
