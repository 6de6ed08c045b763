// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "model/force_log.h"
#include "model/identify.h"

namespace bladecurve {

// A material file that `torque` reads, with how well its numbers are known under "identified".
[[nodiscard]] std::string MaterialFileText(const Identification& found,
                                           const IdentifyInput& input,
                                           const std::string& name);

// {"format":"bladecurve-material/1","status":"refused","reason":..,"detail":..}, one line.
[[nodiscard]] std::string LogRefusalText(const LogRefused& refusal);

// Both numbers, every cut and every doubt, for a person, by lines.
[[nodiscard]] std::string IdentificationSummary(const Identification& found);

}  // namespace bladecurve
