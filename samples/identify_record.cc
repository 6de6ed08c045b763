// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/identify_record.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/degrees.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "bladecurve-material/1";
constexpr auto kDoubts = std::to_array<std::pair<const char*, const char*>>(
    {{"one_cut", "one cut shows no scatter, so nothing says how well these numbers are known"},
     {"one_empty_run", "one empty run shows no scatter: the uncertainty leaves friction out"},
     {"blade_uncertainty_unknown", "the blade has no covariance: the uncertainty leaves it out"},
     {"length_mismatch", "the blade puts the end of the plate elsewhere than --x-end-mm"},
     {"contact_offset", "the blade meets the plate elsewhere than --x-edge-mm or phi have it"}});

// What is not known is null.
Json IdentifiedJson(const Identified& value) {
  return {{"standard_deviation", value.deviation},
          {"uncertainty", value.uncertainty},
          {"uncertainty_from_blade", value.from_blade}};
}

std::string Text(const Json& json, int indent) {
  // File names need not be UTF-8; replacing what is not keeps the text valid JSON.
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string ValueLine(const char* name, const Identified& value, const char* unit) {
  const std::string mean = fmt::format("  {:<4} {:.4g} {}", name, value.mean, unit);
  if (std::isnan(value.uncertainty)) return mean + ", uncertainty unknown\n";
  return fmt::format(
      "{}, standard uncertainty {:.2g} (of the blade {:.2g}); cuts scatter by {:.2g}\n",
      mean,
      value.uncertainty,
      value.from_blade,
      value.deviation);
}

std::string CutLine(const IdentifiedCut& cut) {
  return fmt::format(
      "  {}: contact {:.2f} deg, cut from {:.2f} to {:.2f} deg over {:.4g} mm, J_c {:.4g} kJ/m2, "
      "k {:.4g} N/mm\n",
      cut.source,
      cut.phases.contact_rad * kDegPerRad,
      cut.phases.start_rad * kDegPerRad,
      cut.phases.end_rad * kDegPerRad,
      cut.length_mm,
      cut.toughness_n_per_mm,
      cut.phases.stiffness_n_per_mm);
}

std::string DoubtLine(const std::string& doubt) {
  for (const auto& [code, meaning] : kDoubts) {
    if (doubt == code) return fmt::format("  doubt {}: {}\n", code, meaning);
  }
  return fmt::format("  doubt {}\n", doubt);
}

}  // namespace

std::string MaterialFileText(const Identification& found,
                             const IdentifyInput& input,
                             const std::string& name) {
  const Json material = {{"format", kFormat},
                         {"name", name},
                         {"toughness_kj_per_m2", found.toughness_n_per_mm.mean},
                         {"thickness_mm", input.thickness_mm},
                         {"stiffness_n_per_mm", found.stiffness_n_per_mm.mean},
                         {"identified",
                          {{"toughness_kj_per_m2", IdentifiedJson(found.toughness_n_per_mm)},
                           {"stiffness_n_per_mm", IdentifiedJson(found.stiffness_n_per_mm)},
                           {"blade", input.blade.name},
                           {"cuts", input.cuts.size()},
                           {"empty_runs", input.empties.size()},
                           {"doubts", found.doubts}}}};
  return Text(material, 1) + "\n";
}

std::string LogRefusalText(const LogRefused& refusal) {
  const Json record = {{"format", kFormat},
                       {"status", "refused"},
                       {"reason", refusal.code()},
                       {"detail", refusal.what()}};
  return Text(record, -1);
}

std::string IdentificationSummary(const Identification& found) {
  std::string text = ValueLine("J_c", found.toughness_n_per_mm, "kJ/m2") +
                     ValueLine("k", found.stiffness_n_per_mm, "N/mm");
  for (const IdentifiedCut& cut : found.cuts) text += CutLine(cut);
  for (const std::string& doubt : found.doubts) text += DoubtLine(doubt);
  return text;
}

}  // namespace bladecurve
