// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vision/refused.h"

namespace bladecurve {

// {"format":"bladecurve/1","status":"refused","reason":..,"detail":..,"photo":..}, one line, no
// newline.
[[nodiscard]] std::string RefusalText(const Refused& refusal, const std::string& photo);

}  // namespace bladecurve
