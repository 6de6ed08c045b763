// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>

#include "model/blade_json.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

void AppendNumber(double value, std::string& text) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 32> buffer;
  text.append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

std::string Quoted(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void Append(const Json& value, std::string& text) {
  if (value.is_number_float()) return AppendNumber(value.get<double>(), text);
  if (value.is_string()) {
    text += Quoted(value.get_ref<const std::string&>());
    return;
  }
  if (!value.is_structured()) {
    text += value.dump();
    return;
  }
  const bool is_object = value.is_object();
  text += is_object ? '{' : '[';
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    if (!first) text += ',';
    first = false;
    if (is_object) text += Quoted(key) + ':';
    Append(item, text);
  }
  text += is_object ? '}' : ']';
}

}  // namespace

std::string JsonText(const Json& value) {
  std::string text;
  Append(value, text);
  return text;
}

std::string JsonTextByLines(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items()) {
    text += text.empty() ? "{\n" : ",\n";
    text += Quoted(key) + ": ";
    Append(value, text);
  }
  return text.empty() ? "{}\n" : text + "\n}\n";
}

}  // namespace bladecurve
