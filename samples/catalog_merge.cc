// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_merge.h"

#include <algorithm>

#include "samples/catalog_plan.h"
#include "samples/catalog_row.h"
#include "samples/catalog_rows_file.h"
#include "samples/catalog_sqlite.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::map<std::string, std::vector<Json>> RowsByInstrument(const fs::path& out) {
  std::map<std::string, std::vector<Json>> rows;
  for (Json& row : ReadRows(out)) rows[row.value("instrument", "")].push_back(std::move(row));
  return rows;
}

// A finished row where there is one; else the accident of the last attempt; else nothing.
const Json* RowWithKey(const std::vector<Json>& rows, const std::string& key) {
  const Json* accident = nullptr;
  for (const Json& row : rows) {
    if (row.value("key", "") != key) continue;
    if (row.value("status", "") != "error") return &row;
    accident = &row;
  }
  return accident;
}

std::vector<Json> ChooseRows(const CatalogPlan& plan,
                             const std::map<std::string, std::vector<Json>>& rows) {
  std::vector<Json> chosen;
  for (const Instrument& instrument : plan.instruments) {
    const auto found = rows.find(instrument.name);
    if (found == rows.end()) continue;
    const Json* row = RowWithKey(found->second, RowKey(IdentityOf(plan, instrument)));
    if (row != nullptr) chosen.push_back(*row);
  }
  return chosen;
}

}  // namespace

std::vector<Json> CurrentRows(const fs::path& out) {
  return ChooseRows(ReadPlan(out), RowsByInstrument(out));
}

CatalogStatus StatusOfCatalog(const fs::path& out) {
  const CatalogPlan plan = ReadPlan(out);
  const std::vector<Json> rows = ChooseRows(plan, RowsByInstrument(out));
  CatalogStatus status;
  status.planned = static_cast<int>(plan.instruments.size());
  for (const Json& row : rows) {
    ++status.by_status[row.value("status", "")];
    if (row.contains("reason")) ++status.by_reason[row.value("reason", "")];
  }
  for (const Instrument& instrument : plan.instruments) {
    const bool done = std::any_of(rows.begin(), rows.end(), [&](const Json& row) {
      return row.value("instrument", "") == instrument.name;
    });
    if (!done) status.missing.push_back(instrument.name);
  }
  return status;
}

void MergeCatalog(const fs::path& out) {
  std::string lines, table = CsvHeader();
  const std::vector<Json> rows = CurrentRows(out);
  for (const Json& row : rows) {
    lines += row.dump() + "\n";
    table += CsvRows(row);
  }
  WriteFileWhole(out / "catalog.jsonl", lines);
  WriteFileWhole(out / "catalog.csv", table);
  WriteSqlite(out / "catalog.sqlite", rows);
}

}  // namespace bladecurve
