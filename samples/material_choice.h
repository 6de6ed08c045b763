// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "model/plate.h"

namespace bladecurve {

// The materials that come with the program, by the stems of their files in samples/materials.
[[nodiscard]] std::vector<std::string> MaterialNames();

// One of them by name, or a material file. Throws std::invalid_argument for what is neither.
[[nodiscard]] Material ChooseMaterial(const std::string& name_or_file);

}  // namespace bladecurve
