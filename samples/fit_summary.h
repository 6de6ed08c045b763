// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "samples/analysis.h"

namespace bladecurve {

// A few lines for a person: status, coefficients with standard errors, misfit, and pose of each
// photograph.
[[nodiscard]] std::string FitSummaryText(const Analysis& analysis, bool pixels);

// "NAME: ok" or "NAME: review: codes".
[[nodiscard]] std::string StatusLine(const Analysis& analysis, const std::string& name);

}  // namespace bladecurve
