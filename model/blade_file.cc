// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_file.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "model/blade_json.h"
#include "model/plugin_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = 256u << 20u;  // rejects films and disk images

[[noreturn]] void Complain(const fs::path& path, const std::string& what) {
  throw std::invalid_argument(path.string() + ": " + what);
}

std::string ReadBytes(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) Complain(path, "there is no such file; check the name");
  if (fs::is_directory(path, error))
    Complain(path, "is a folder; name a .blade.json or a .so in it");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kLargestFile)
    Complain(path, "is too large for a blade; name a .blade.json or a .so");
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) Complain(path, "cannot be read; check its permissions");
  return bytes;
}

// The parser's own words, without its code and without line ends.
std::string ParserComplaint(const std::string& what) {
  const std::size_t bracket = what.find("] ");
  std::string text = bracket == std::string::npos ? what : what.substr(bracket + 2);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

BladeFile ReadJson(const fs::path& path, const std::string& bytes) {
  if (bytes.empty()) Complain(path, "is empty; it must be a .blade.json or a .so");
  try {
    return BladeFileOfJson(Json::parse(bytes));
  } catch (const Json::exception& error) {
    Complain(path, "is no JSON: " + ParserComplaint(error.what()) + "; correct it there");
  } catch (const std::invalid_argument& error) {
    Complain(path, error.what());
  }
}

bool IsSharedLibrary(const std::string& bytes) {
  return bytes.starts_with(
             "\x7f"
             "ELF") ||
         bytes.starts_with("\xcf\xfa\xed\xfe");  // Linux, macOS
}

OrderedJson NumberOrNull(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson();
}

OrderedJson CovarianceJson(const BladeFile& blade, const std::vector<std::string>& names) {
  OrderedJson matrix = OrderedJson::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    OrderedJson row = OrderedJson::array();
    for (std::size_t j = 0; j < names.size(); ++j) {
      row.push_back(NumberOrNull(blade.covariance[i * names.size() + j]));
    }
    matrix.push_back(row);
  }
  return {{"parameters", names}, {"matrix", matrix}};
}

OrderedJson StandardErrorsJson(const BladeFile& blade, const std::vector<std::string>& names) {
  OrderedJson errors = OrderedJson::object();
  for (std::size_t i = 0; i < blade.standard_errors.size(); ++i) {
    if (std::isfinite(blade.standard_errors[i])) errors[names[i]] = blade.standard_errors[i];
  }
  return errors;
}

}  // namespace

std::vector<std::string> ParameterNames(const BladeShape& shape) {
  if (std::holds_alternative<TaperedRectangle>(shape)) return {"a_mm", "b", "gain"};
  std::vector<std::string> names(std::get<RigidSpline>(shape).coefficients_mm.size(), "c");
  for (std::size_t i = 0; i < names.size(); ++i) names[i] += std::to_string(i) + "_mm";
  return names;
}

std::vector<double> ParameterValues(const BladeShape& shape) {
  if (const auto* s = std::get_if<TaperedRectangle>(&shape)) return {s->a_mm, s->b, s->gain};
  return std::get<RigidSpline>(shape).coefficients_mm;
}

BladeFile ReadBladeFile(const fs::path& path) {
  const std::string bytes = ReadBytes(path);
  if (!IsSharedLibrary(bytes)) return ReadJson(path, bytes);
  try {
    return ReadPluginFile(path);
  } catch (const std::invalid_argument& error) {
    Complain(path, error.what());
  }
}

std::string BladeFileText(const BladeFile& blade) {
  const std::vector<std::string> names = ParameterNames(blade.curve.shape());
  OrderedJson record = {{"format", "bladecurve/1"},
                        {"name", blade.name},
                        {"status", blade.status},
                        {"warnings", blade.warnings},
                        {"curve", CurveJson(blade.curve.shape())},
                        {"domain", DomainJson(blade.curve.domain())}};
  const OrderedJson errors = StandardErrorsJson(blade, names);
  if (!blade.covariance.empty()) {
    record["covariance"] = CovarianceJson(blade, names);
  } else if (!errors.empty()) {
    record["standard_errors"] = errors;
  }
  if (std::isfinite(blade.fit_rms_mm)) record["fit"] = {{"rms_mm", blade.fit_rms_mm}};
  return JsonTextByLines(record);
}

}  // namespace bladecurve
