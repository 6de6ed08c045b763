// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace bladecurve {

// Writes all or nothing: into a neighbouring file first, which then takes the name. A reader, or a
// killed run, never sees half a file. Throws std::runtime_error naming the file.
void WriteFileWhole(const std::filesystem::path& path, std::string_view bytes);

// Throws std::runtime_error where WriteFileWhole would, as far as can be told beforehand: to be
// called before work whose result would be lost.
void RequireWritable(const std::filesystem::path& path);

}  // namespace bladecurve
