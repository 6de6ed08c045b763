// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "samples/validation_run.h"

namespace bladecurve {

// A self-contained SVG: error over time, log-log, one panel a quantity, one dot a scene. Refused
// scenes are named below, not left out.
[[nodiscard]] std::string WorkPrecisionSvg(const std::vector<ValidationRow>& rows);

}  // namespace bladecurve
