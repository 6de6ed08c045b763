// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "samples/analysis.h"

namespace bladecurve {

struct RecordOptions {
  std::string name;   // "name" in the file
  bool times = true;  // false leaves every ms out: the same input then gives the same bytes
};

// The codes of all photographs and of the fit, each once, in the order they came up.
[[nodiscard]] std::vector<std::string> Warnings(const Analysis& analysis);

// "ok", or "review" where there are warnings.
[[nodiscard]] std::string Status(const Analysis& analysis);

// The "curve" object: family and its numbers.
[[nodiscard]] nlohmann::ordered_json CurveRecord(const BladeCurve& curve);

// NAME.blade.json, format "bladecurve/1": one line a top-level key, numbers in the shortest form
// that reads back exactly, what is unknown is null; ends in a newline.
[[nodiscard]] std::string BladeRecordText(const Analysis& analysis, const RecordOptions& options);

}  // namespace bladecurve
