// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "model/plate.h"

namespace bladecurve {

// A material file, format "bladecurve-material/1":
//   {"format":"bladecurve-material/1", "name":.., "toughness_kj_per_m2": J_c, "thickness_mm": h,
//    "stiffness_n_per_mm": k   or   "force_deflection": {"delta_mm": [0, ..], "force_n": [0, ..]}}
// Other keys are left alone. Throws std::invalid_argument "FILE: key: what is wrong".
[[nodiscard]] Material ReadMaterialFile(const std::filesystem::path& path);

// The same of a text; `source` stands for the file in messages.
[[nodiscard]] Material ParseMaterial(std::string_view text, const std::string& source);

}  // namespace bladecurve
