// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "samples/analysis.h"
#include "samples/catalog_plan.h"

namespace bladecurve {

// What a result depends on: the photographs' bytes, the settings and the software version.
struct RowIdentity {
  std::string instrument;
  std::vector<std::string> photos;
  std::vector<std::string> sha256;  // one a photograph; empty where the file cannot be read
  std::string settings;             // the flags, joined
};

// The catalog's flags, replaced and extended by the instrument's own.
[[nodiscard]] std::vector<std::string> ArgumentsFor(const CatalogPlan& plan,
                                                    const Instrument& instrument);

// Reads the photographs' bytes.
[[nodiscard]] RowIdentity IdentityOf(const CatalogPlan& plan, const Instrument& instrument);

// SHA-256 over all of it: equal keys, equal results.
[[nodiscard]] std::string RowKey(const RowIdentity& identity);

// One row of a catalog, without times: the same input gives the same bytes.
[[nodiscard]] nlohmann::ordered_json MeasuredRow(const RowIdentity& identity,
                                                 const Analysis& analysis);
[[nodiscard]] nlohmann::ordered_json RefusedRow(const RowIdentity& identity,
                                                const PhotoRefused& refusal);
// Status "error": an accident, not a judgement about the photograph; it is tried again by the next
// run.
[[nodiscard]] nlohmann::ordered_json ErrorRow(const RowIdentity& identity,
                                              const std::string& message);

// A row of the file catalog.csv for each photograph of a row, and its header line.
[[nodiscard]] std::string CsvHeader();
[[nodiscard]] std::string CsvRows(const nlohmann::ordered_json& row);

}  // namespace bladecurve
