// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace bladecurve {

// Writes the rows of a catalog into an SQLite file: table `instruments`, one row each, its curve as
// JSON; table `photos`, one row a photograph. The same rows give the same bytes. Replaces the file,
// all or nothing. Throws std::runtime_error naming the file.
void WriteSqlite(const std::filesystem::path& path,
                 const std::vector<nlohmann::ordered_json>& rows);

}  // namespace bladecurve
