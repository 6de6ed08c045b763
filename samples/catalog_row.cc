// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "samples/blade_record.h"
#include "samples/csv_text.h"
#include "samples/fitted_photo.h"
#include "vision/photo/sha256.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

std::string FlagName(const std::string& argument) { return argument.substr(0, argument.find('=')); }

std::string HashOfFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return file ? Sha256Hex(bytes) : std::string();
}

Json RowHead(const RowIdentity& identity, const std::string& status) {
  return {{"instrument", identity.instrument},
          {"key", RowKey(identity)},
          {"settings", identity.settings},
          {"version", BLADECURVE_VERSION},
          {"status", status}};
}

Json UnmeasuredPhotos(const RowIdentity& identity) {
  Json photos = Json::array();
  for (std::size_t i = 0; i < identity.photos.size(); ++i) {
    photos.push_back({{"file", identity.photos[i]}, {"sha256", identity.sha256[i]}});
  }
  return photos;
}

Json MeasuredPhotos(const RowIdentity& identity, const Analysis& analysis) {
  Json photos = UnmeasuredPhotos(identity);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const PhotoMeasurement& measured = analysis.photos[i];
    const FittedPhoto fitted = ApplyPose(measured, analysis.fit.poses[i]);
    photos[i].update({{"theta_rad", fitted.theta_rad},
                      {"theta_sigma_rad", fitted.theta_sigma_rad},
                      {"pivot_px", {fitted.pivot_px.x(), fitted.pivot_px.y()}},
                      {"pivot_sigma_px", fitted.pivot_sigma_px},
                      {"mm_per_px", fitted.mm_per_px},
                      {"scale_source", measured.scale_source}});
  }
  return photos;
}

// A value as a CSV field: text bare, lists with spaces, absent and unknown empty.
std::string Field(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return {};
  if (found->is_string()) return found->get<std::string>();
  if (!found->is_array()) return found->dump();
  std::vector<std::string> parts;
  for (const Json& part : *found) {
    parts.push_back(part.is_string() ? part.get<std::string>() : part.dump());
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

constexpr const char* kRowColumns[] = {"instrument", "status", "reason", "warnings"};
constexpr const char* kPhotoColumns[] = {"file",
                                         "theta_rad",
                                         "theta_sigma_rad",
                                         "pivot_px",
                                         "pivot_sigma_px",
                                         "mm_per_px",
                                         "scale_source",
                                         "sha256"};
constexpr const char* kCurveColumns[] = {
    "family", "a_mm", "b", "gain", "degree", "knots_mm", "coefficients_mm"};
constexpr const char* kLastColumns[] = {"rms_mm", "detail"};

}  // namespace

std::vector<std::string> ArgumentsFor(const CatalogPlan& plan, const Instrument& instrument) {
  std::vector<std::string> arguments;
  for (const std::string& common : plan.arguments) {
    const bool replaced = std::any_of(
        instrument.arguments.begin(), instrument.arguments.end(), [&](const std::string& own) {
          return FlagName(own) == FlagName(common);
        });
    if (!replaced) arguments.push_back(common);
  }
  arguments.insert(arguments.end(), instrument.arguments.begin(), instrument.arguments.end());
  return arguments;
}

RowIdentity IdentityOf(const CatalogPlan& plan, const Instrument& instrument) {
  RowIdentity identity;
  identity.instrument = instrument.name;
  identity.settings = fmt::format("{}", fmt::join(ArgumentsFor(plan, instrument), " "));
  for (const std::filesystem::path& photo : instrument.photos) {
    identity.photos.push_back(photo.string());
    identity.sha256.push_back(HashOfFile(photo));
  }
  return identity;
}

std::string RowKey(const RowIdentity& identity) {
  return Sha256Hex(fmt::format("{}\n{}\n{}\n{}\n{}",
                               BLADECURVE_VERSION,
                               identity.instrument,
                               identity.settings,
                               fmt::join(identity.photos, "\n"),
                               fmt::join(identity.sha256, "\n")));
}

Json MeasuredRow(const RowIdentity& identity, const Analysis& analysis) {
  Json row = RowHead(identity, Status(analysis));
  row["warnings"] = Warnings(analysis);
  row["curve"] = CurveRecord(analysis.fit.recommended.curve);
  row["rms_mm"] = analysis.fit.recommended.rms_mm;
  row["photos"] = MeasuredPhotos(identity, analysis);
  return row;
}

Json RefusedRow(const RowIdentity& identity, const PhotoRefused& refusal) {
  Json row = RowHead(identity, "refused");
  row["reason"] = ReasonCode(refusal.reason());
  row["detail"] = refusal.what();
  row["photos"] = UnmeasuredPhotos(identity);
  return row;
}

Json ErrorRow(const RowIdentity& identity, const std::string& message) {
  Json row = RowHead(identity, "error");
  row["detail"] = message;
  row["photos"] = UnmeasuredPhotos(identity);
  return row;
}

std::string CsvHeader() {
  std::vector<std::string> names(std::begin(kRowColumns), std::end(kRowColumns));
  names.insert(names.end(), std::begin(kPhotoColumns), std::end(kPhotoColumns));
  names.insert(names.end(), std::begin(kCurveColumns), std::end(kCurveColumns));
  names.insert(names.end(), std::begin(kLastColumns), std::end(kLastColumns));
  return CsvLine(names);
}

std::string CsvRows(const Json& row) {
  const Json curve = row.value("curve", Json::object());
  std::string text;
  for (const Json& photo : row.at("photos")) {
    std::vector<std::string> fields;
    for (const char* column : kRowColumns) fields.push_back(Field(row, column));
    for (const char* column : kPhotoColumns) fields.push_back(Field(photo, column));
    for (const char* column : kCurveColumns) fields.push_back(Field(curve, column));
    for (const char* column : kLastColumns) fields.push_back(Field(row, column));
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace bladecurve
