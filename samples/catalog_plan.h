// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bladecurve {

// One pair of scissors: all photographs of it are fitted together.
struct Instrument {
  std::string name;                           // unique, fit to be a file name
  std::vector<std::filesystem::path> photos;  // in order
  std::vector<std::string> arguments;         // flags for this one alone, after the catalog's own
};

// What a catalog run is to do. Stands in the output folder as manifest.csv
// (instrument,photos,flags) and plan.json (the flags for all).
struct CatalogPlan {
  std::vector<Instrument> instruments;  // by name
  std::vector<std::string> arguments;   // "--mm-per-px=0.1", ...
};

// Every photograph directly in `folder` is an instrument, and every sub-folder with photographs one
// of several. Files are taken by ending: jpg, jpeg, png, tif, tiff, heic, heif. Throws
// std::invalid_argument where none is found.
[[nodiscard]] std::vector<Instrument> InstrumentsInFolder(const std::filesystem::path& folder);

// A CSV file with the columns instrument, photos (separated by ';', relative to the file's folder)
// and, optionally, flags. Throws std::invalid_argument naming file and row.
[[nodiscard]] std::vector<Instrument> InstrumentsInManifest(const std::filesystem::path& manifest);

// Both create the folder's files or read them back. Throw std::runtime_error,
// std::invalid_argument.
void WritePlan(const std::filesystem::path& out, const CatalogPlan& plan);
[[nodiscard]] CatalogPlan ReadPlan(const std::filesystem::path& out);

}  // namespace bladecurve
