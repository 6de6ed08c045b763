// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "model/blade_file.h"

namespace bladecurve {

// Reads the text of a .blade.json.
// Throws std::invalid_argument "key: what is wrong; what to do" on one line.
[[nodiscard]] BladeFile ParseBladeJson(const std::string& text);

}  // namespace bladecurve
