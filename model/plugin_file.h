// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "model/blade_file.h"

namespace bladecurve {

// Loads a plugin (blade_plugin.h) and rebuilds the curve it declares; the library is closed again.
// Throws std::invalid_argument "what is wrong; what to do" where it is none, is of another version,
// or evaluates to other values than the curve it declares.
[[nodiscard]] BladeFile ReadPluginFile(const std::filesystem::path& path);

}  // namespace bladecurve
