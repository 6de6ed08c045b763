// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "model/blade_curve.h"

namespace bladecurve {

// A blade as it stands in a file: NAME.blade.json, format "bladecurve/1", or an exported plugin.
struct BladeFile {
  std::string name;
  BladeCurve curve;
  std::string status = "ok";               // "ok" or "review"
  std::vector<std::string> warnings = {};  // stable codes
  // One for each of ParameterNames(curve.shape()), in its units; NaN: unknown.
  std::vector<double> standard_errors = {};
  // Of the same parameters, row by row; NaN where unknown, empty if the file has none (a plugin).
  std::vector<double> covariance = {};
  double fit_rms_mm = std::numeric_limits<double>::quiet_NaN();
  // Of the .blade.json that a plugin was made from, hexadecimal; "" if unknown.
  std::string source_sha256 = {};
  // Measured without a scale ("units": "px"): every mm of it is a pixel.
  bool in_pixels = false;
};

// Throws std::invalid_argument for a blade in pixels, which cuts nothing.
void RequireMillimetres(const BladeFile& blade);

// "a_mm", "b", "gain", or "c0_mm", "c1_mm", ...: the shape's numbers that a fit estimates.
[[nodiscard]] std::vector<std::string> ParameterNames(const BladeShape& shape);

// The same numbers, in that order.
[[nodiscard]] std::vector<double> ParameterValues(const BladeShape& shape);

// Reads either form; a shared library is recognised by its first bytes. Only format, name, curve
// and domain must be there; unknown keys are left alone; gain is 1/2 unless given.
// Reading a plugin runs its code: the curve it declares is rebuilt and must give what it gives.
// Throws std::invalid_argument "FILE: key: what is wrong; what to do" on one line.
[[nodiscard]] BladeFile ReadBladeFile(const std::filesystem::path& path);

// The text of a .blade.json with all that a BladeFile holds: one line a key, numbers in the
// shortest form that reads back exactly.
[[nodiscard]] std::string BladeFileText(const BladeFile& blade);

}  // namespace bladecurve
