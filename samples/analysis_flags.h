// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

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
  bool upper_is_left = false;
  // fit
  std::string family = "auto", gain = "0.5", loss = "huber", knots = "auto";
  std::optional<std::string> degree;
  // other
  std::string plan = "auto";
  std::optional<std::string> debug, threads;
};

void AddAnalysisFlags(CLI::App& command, AnalysisFlags* flags);

// Throws std::invalid_argument naming the flag for a value that cannot be, and for two scales at
// once.
[[nodiscard]] AnalysisSettings SettingsFromFlags(const AnalysisFlags& flags);

// The flags that change a result, one canonical line: equal lines, equal results. Threads are left
// out; files (--camera, --card) stand by name.
[[nodiscard]] std::string SettingsLine(const AnalysisFlags& flags);

}  // namespace bladecurve
