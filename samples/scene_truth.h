// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "vision/render/render.h"

namespace bladecurve {

inline constexpr const char* kTruthSchema = "scissors-heldout/1";

// The truth of a rendered photograph as NAME.truth.json holds it: of that schema, mm and
// degrees, pixels with the centre of the top-left one at (0, 0). `expect`: "ok" or "refuse".
[[nodiscard]] nlohmann::ordered_json SceneTruthJson(const SceneTruth& truth,
                                                    const std::string& file,
                                                    const std::string& expect);

}  // namespace bladecurve
