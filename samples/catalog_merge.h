// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bladecurve {

// Where a catalog stands.
struct CatalogStatus {
  int planned = 0;
  std::map<std::string, int> by_status;  // "ok", "review", "refused", "error"
  std::map<std::string, int> by_reason;  // of the refused
  std::vector<std::string> missing;      // instruments without a row
};

// The valid row of each planned instrument, by name; of several, one for the photographs as they
// are now.
[[nodiscard]] std::vector<nlohmann::ordered_json> CurrentRows(const std::filesystem::path& out);

[[nodiscard]] CatalogStatus StatusOfCatalog(const std::filesystem::path& out);

// Joins the rows of all shards into OUT/catalog.jsonl, .csv and .sqlite, sorted by instrument: the
// same bytes however the work was split.
void MergeCatalog(const std::filesystem::path& out);

}  // namespace bladecurve
