// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/material_file.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace bladecurve {
namespace {

constexpr const char* kFormat = "bladecurve-material/1";

using Json = nlohmann::json;

const Json& Member(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument(std::string(key) + ": missing");
  return *found;
}

double Number(const Json& object, const char* key) {
  const Json& value = Member(object, key);
  if (!value.is_number()) throw std::invalid_argument(std::string(key) + ": must be a number");
  return value.get<double>();
}

std::vector<double> Numbers(const Json& object, const char* key) {
  const Json& value = Member(object, key);
  bool numbers = value.is_array();
  for (const Json& item : value) numbers = numbers && item.is_number();
  if (!numbers) throw std::invalid_argument(std::string(key) + ": must be a list of numbers");
  return value.get<std::vector<double>>();
}

ForceDeflection ForceDeflectionOf(const Json& object) {
  if (!object.contains("force_deflection"))
    return ForceDeflection(Number(object, "stiffness_n_per_mm"));
  if (object.contains("stiffness_n_per_mm")) {
    throw std::invalid_argument("stiffness_n_per_mm and force_deflection: give one of them");
  }
  const Json& table = object["force_deflection"];
  if (!table.is_object()) throw std::invalid_argument("force_deflection: must be an object");
  return {Numbers(table, "delta_mm"), Numbers(table, "force_n")};
}

Material MaterialOf(const Json& object) {
  if (!object.is_object() || object.value("format", Json()) != kFormat) {
    throw std::invalid_argument(std::string("format: must be \"") + kFormat + "\"");
  }
  const Json& name = Member(object, "name");
  if (!name.is_string()) throw std::invalid_argument("name: must be a text");
  Material material{name.get<std::string>(),
                    Number(object, "toughness_kj_per_m2"),
                    Number(object, "thickness_mm"),
                    ForceDeflectionOf(object)};
  CheckMaterial(material);
  return material;
}

}  // namespace

Material ParseMaterial(std::string_view text, const std::string& source) {
  const Json object = Json::parse(text, nullptr, false);
  if (object.is_discarded())
    throw std::invalid_argument(source + ": not JSON; a material file was expected");
  try {
    return MaterialOf(object);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(source + ": " + error.what());
  }
}

Material ReadMaterialFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::invalid_argument(
        path.string() + ": cannot be read; give a material file or one of the names in --help");
  }
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return ParseMaterial(text, path.string());
}

}  // namespace bladecurve
