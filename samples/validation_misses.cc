// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_misses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "samples/validation_table.h"

namespace bladecurve {
namespace {

constexpr double kTwoSided95 = 1.959964;  // standard normal

bool Holds(const StatedError& stated) {
  return std::abs(stated.error) <= kTwoSided95 * stated.sigma;
}

bool Counts(const ValidationRow& row) { return row.measured() && row.expected == "ok"; }

bool Misses(const ValidationRow& row, Quantity quantity) {
  const std::vector<StatedError>& stated = row.Of(quantity).stated;
  return std::any_of(stated.begin(), stated.end(), [](const StatedError& s) {
    return std::isfinite(s.error) && !Holds(s);
  });
}

// Scenes that carry a warning, among those that miss the truth and among the others.
struct Carried {
  int missing = 0, others = 0;
};

}  // namespace

Coverage CoverageOf(const std::vector<ValidationRow>& rows, Quantity quantity) {
  Coverage coverage;
  for (const ValidationRow& row : rows) {
    if (!Counts(row)) continue;
    for (const StatedError& stated : row.Of(quantity).stated) {
      if (!std::isfinite(stated.error)) continue;
      ++coverage.of;
      coverage.held += Holds(stated) ? 1 : 0;
    }
  }
  return coverage;
}

std::string WhyMissed(const std::vector<ValidationRow>& rows, Quantity quantity) {
  constexpr double kFewest = 0.93, kMost = 0.97;
  constexpr int kEnough = 100;  // fewer intervals scatter by more than that
  const Coverage coverage = CoverageOf(rows, quantity);
  if (coverage.of < kEnough) return "";
  const std::string name = QuantityName(quantity);
  if (coverage.share() > kMost)
    return name + ": the stated uncertainty is larger than the errors\n";
  if (coverage.share() >= kFewest) return "";
  std::map<std::string, Carried> carried;
  Carried scenes;
  for (const ValidationRow& row : rows) {
    if (!Counts(row)) continue;
    const bool misses = Misses(row, quantity);
    ++(misses ? scenes.missing : scenes.others);
    for (const std::string& warning : row.warnings)
      ++(misses ? carried[warning].missing : carried[warning].others);
  }
  const auto excess = [&](const Carried& c) {
    return static_cast<double>(c.missing) / std::max(1, scenes.missing) -
           static_cast<double>(c.others) / std::max(1, scenes.others);
  };
  const auto most =
      std::max_element(carried.begin(), carried.end(), [&](const auto& a, const auto& b) {
        return excess(a.second) < excess(b.second);
      });
  if (most == carried.end() || excess(most->second) <= 0) {
    return fmt::format(
        "{}: {} scenes miss the truth, and no warning sets them apart\n", name, scenes.missing);
  }
  return fmt::format("{}: of {} scenes that miss the truth {} warn {}, of the other {} scenes {}\n",
                     name,
                     scenes.missing,
                     most->second.missing,
                     most->first,
                     scenes.others,
                     most->second.others);
}

}  // namespace bladecurve
