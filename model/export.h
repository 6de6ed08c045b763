// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "model/blade_file.h"

namespace bladecurve {

// The blade as one C99 file that needs <math.h> alone and implements blade_plugin.h. Compiled with
// -ffp-contract=off its values equal BladeCurve's to the last bit; it is C++ as well.
[[nodiscard]] std::string PluginSource(const BladeFile& blade);

// Compiles such a text into a shared library by the system's C compiler: $CC, else cc. The library
// appears under its name only when it is complete. Throws std::runtime_error where there is no
// compiler, with its first complaint where it fails.
void CompilePlugin(const std::string& source, const std::filesystem::path& library);

}  // namespace bladecurve
