// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "samples/csv_text.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

bool IsPhotograph(const fs::path& path) {
  static constexpr std::array<const char*, 7> kEndings = {
      ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".heic", ".heif"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

// The photographs below `folder`, by the folder they lie in; paths relative to `folder`.
std::map<fs::path, std::vector<fs::path>> PhotographsByFolder(const fs::path& folder) {
  std::map<fs::path, std::vector<fs::path>> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !IsPhotograph(entry.path())) continue;
    const fs::path relative = entry.path().lexically_relative(folder);
    found[relative.parent_path()].push_back(relative);
  }
  for (auto& [_, photos] : found) std::sort(photos.begin(), photos.end());
  return found;
}

std::string FileSafe(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

// The stem, unless two files share it: then the whole name tells them apart.
std::vector<std::string> NamesOf(const std::vector<fs::path>& photos) {
  std::map<std::string, int> uses;
  for (const fs::path& photo : photos) ++uses[photo.stem().string()];
  std::vector<std::string> names;
  for (const fs::path& photo : photos) {
    const bool unique = uses[photo.stem().string()] == 1;
    names.push_back((unique ? photo.stem() : photo.filename()).string());
  }
  return names;
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

void SortAndRequireUnique(std::vector<Instrument>& instruments, const std::string& source) {
  std::sort(instruments.begin(), instruments.end(), [](const Instrument& a, const Instrument& b) {
    return a.name < b.name;
  });
  const auto twice = std::adjacent_find(
      instruments.begin(), instruments.end(), [](const Instrument& a, const Instrument& b) {
        return a.name == b.name;
      });
  if (twice != instruments.end()) {
    throw std::invalid_argument(fmt::format(
        "{}: two instruments are called '{}'; give each its own name", source, twice->name));
  }
}

std::string ReadWhole(const fs::path& path, const char* remedy) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(fmt::format("cannot read {}; {}", path.string(), remedy));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Instrument InstrumentFromRow(const std::vector<std::string>& row, const fs::path& folder) {
  if (row.size() < 2 || row.size() > 3) {
    throw std::invalid_argument(
        fmt::format("{} fields; wants instrument,photos or instrument,photos,flags", row.size()));
  }
  Instrument instrument;
  instrument.name = row[0];
  if (row[0].empty() || row[0].find('/') != std::string::npos) {
    throw std::invalid_argument(
        fmt::format("'{}' cannot be an instrument's name: it becomes a file name", row[0]));
  }
  for (const std::string& photo : Split(row[1], ';')) instrument.photos.push_back(folder / photo);
  if (instrument.photos.empty()) throw std::invalid_argument("no photograph");
  if (row.size() == 3) instrument.arguments = Split(row[2], ' ');
  return instrument;
}

std::string ManifestName(const fs::path& photo) {
  if (photo.string().find(';') != std::string::npos) {
    throw std::invalid_argument(
        fmt::format("{}: ';' parts photographs in a manifest; rename the file", photo.string()));
  }
  return photo.string();
}

}  // namespace

std::vector<Instrument> InstrumentsInFolder(const fs::path& folder) {
  std::vector<Instrument> instruments;
  const fs::path absolute = fs::absolute(folder).lexically_normal();
  for (const auto& [sub_folder, photos] : PhotographsByFolder(absolute)) {
    std::vector<fs::path> paths;
    for (const fs::path& photo : photos) paths.push_back(absolute / photo);
    if (!sub_folder.empty()) {
      instruments.push_back({FileSafe(sub_folder.string()), paths, {}});
      continue;
    }
    const std::vector<std::string> names = NamesOf(photos);
    for (std::size_t i = 0; i < paths.size(); ++i)
      instruments.push_back({names[i], {paths[i]}, {}});
  }
  if (instruments.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no photographs (jpg, png, tif, heic) in it; give a folder of photographs "
                    "or a manifest",
                    folder.string()));
  }
  SortAndRequireUnique(instruments, folder.string());
  return instruments;
}

std::vector<Instrument> InstrumentsInManifest(const fs::path& manifest) {
  const auto rows = ParseCsv(ReadWhole(manifest, "give a folder of photographs or a CSV file"));
  if (rows.empty() || rows[0].size() < 2 || rows[0][0] != "instrument" || rows[0][1] != "photos") {
    throw std::invalid_argument(
        fmt::format("{}: the first line must be instrument,photos or instrument,photos,flags",
                    manifest.string()));
  }
  const fs::path folder = fs::absolute(manifest).parent_path();
  std::vector<Instrument> instruments;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    try {
      instruments.push_back(InstrumentFromRow(rows[i], folder));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("{}: row {}: {}", manifest.string(), i + 1, error.what()));
    }
  }
  SortAndRequireUnique(instruments, manifest.string());
  return instruments;
}

void WritePlan(const fs::path& out, const CatalogPlan& plan) {
  fs::create_directories(out);
  std::string manifest = CsvLine({"instrument", "photos", "flags"});
  for (const Instrument& instrument : plan.instruments) {
    std::vector<std::string> photos;
    for (const fs::path& photo : instrument.photos) photos.push_back(ManifestName(photo));
    manifest += CsvLine({instrument.name,
                         fmt::format("{}", fmt::join(photos, ";")),
                         fmt::format("{}", fmt::join(instrument.arguments, " "))});
  }
  WriteFileWhole(out / "manifest.csv", manifest);
  const nlohmann::ordered_json record = {{"format", "bladecurve-catalog/1"},
                                         {"flags", plan.arguments}};
  WriteFileWhole(out / "plan.json", record.dump() + "\n");
}

CatalogPlan ReadPlan(const fs::path& out) {
  const char* remedy = "'bladecurve catalog plan DIR -o OUT' makes it";
  CatalogPlan plan;
  const auto record = nlohmann::json::parse(
      ReadWhole(out / "plan.json", remedy), nullptr, /*allow_exceptions=*/false);
  if (!record.is_object() || record.value("format", "") != "bladecurve-catalog/1" ||
      !record.contains("flags") || !record["flags"].is_array()) {
    throw std::invalid_argument(
        fmt::format("{}: not a catalog plan; {}", (out / "plan.json").string(), remedy));
  }
  for (const auto& flag : record["flags"])
    plan.arguments.push_back(flag.is_string() ? flag.get<std::string>() : "");
  plan.instruments = InstrumentsInManifest(out / "manifest.csv");
  return plan;
}

}  // namespace bladecurve
