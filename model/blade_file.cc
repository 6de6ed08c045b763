// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_file.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "model/blade_json.h"
#include "model/plugin_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFile = 256u << 20u;  // rejects films and disk images

[[noreturn]] void ComplainOfFile(const fs::path& path, const std::string& what) {
  throw std::invalid_argument(path.string() + ": " + what);
}

std::string ReadBytes(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) ComplainOfFile(path, "there is no such file; check the name");
  if (fs::is_directory(path, error)) {
    ComplainOfFile(path, "is a folder; name a .blade.json or a .so in it");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kLargestFile) {
    ComplainOfFile(path, "is too large for a blade; name a .blade.json or a .so");
  }
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) ComplainOfFile(path, "cannot be read; check its permissions");
  return bytes;
}

bool IsSharedLibrary(const std::string& bytes) {
  return bytes.starts_with("\177ELF") || bytes.starts_with("\xcf\xfa\xed\xfe");  // Linux, macOS
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

void RequireMillimetres(const BladeFile& blade) {
  if (!blade.in_pixels) return;
  throw std::invalid_argument(blade.name +
                              ": the curve is in pixels, for it was fitted with --units px; fit it "
                              "with a scale, such as --marker-mm");
}

BladeFile ReadBladeFile(const fs::path& path) {
  const std::string bytes = ReadBytes(path);
  try {
    return IsSharedLibrary(bytes) ? ReadPluginFile(path) : ParseBladeJson(bytes);
  } catch (const std::invalid_argument& error) {
    ComplainOfFile(path, error.what());
  }
}

}  // namespace bladecurve
