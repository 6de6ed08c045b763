// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "model/blade_file.h"

// For .cc files that read or write parts of a .blade.json; no public header includes it.
namespace bladecurve {

// The values of the keys "curve" and "domain".
[[nodiscard]] nlohmann::ordered_json CurveJson(const BladeShape& shape);
[[nodiscard]] nlohmann::ordered_json DomainJson(const CurveDomain& domain);

// The inverse, of a whole record. Throws std::invalid_argument "key: what is wrong; what to do".
[[nodiscard]] BladeFile BladeFileOfJson(const nlohmann::json& record);

// JSON on one line; numbers by std::to_chars, NaN and Inf as null, broken UTF-8 replaced.
[[nodiscard]] std::string JsonText(const nlohmann::ordered_json& value);

// The same with one line for each key of the outermost object; ends in a newline.
[[nodiscard]] std::string JsonTextByLines(const nlohmann::ordered_json& object);

}  // namespace bladecurve
