// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samples/analysis.h"

namespace CLI {
class App;
}

namespace bladecurve {

// The flags that say how photographs are measured and fitted, as typed; `fit` and `catalog` share
// them.
struct AnalysisFlags {
  // scale
  std::optional<std::string> card, marker_mm, mm_per_px, dpi, length_mm, print_scale;
  std::string units = "mm";
  // hints
  std::optional<std::string> theta_deg, pivot, tips_toward, roi, plane_height_mm, camera;
  bool upper_is_left = false;  // it always is
  // fit
  std::string family = "auto", gain = "0.5", loss = "huber", knots = "auto";
  std::optional<std::string> degree;
  // other
  std::string plan = "auto";
  std::optional<std::string> debug, threads;
};

// Those that change a result: not --debug and --threads.
void AddAnalysisFlags(CLI::App& command, AnalysisFlags* flags);

// Throws std::invalid_argument naming the flag for a value that cannot be, and for two scales at
// once.
[[nodiscard]] AnalysisSettings SettingsFromFlags(const AnalysisFlags& flags);

// The analysis flags given to `command`, as "--name=value" in a fixed order: equal arguments, equal
// results. Files (--camera, --card) stand by name.
[[nodiscard]] std::vector<std::string> GivenArguments(const CLI::App& command);

// The reverse. Throws std::invalid_argument for an unknown flag or a value that cannot be.
[[nodiscard]] AnalysisFlags FlagsFromArguments(const std::vector<std::string>& arguments);

}  // namespace bladecurve
