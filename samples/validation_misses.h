// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "samples/validation_run.h"

namespace bladecurve {

// How often the 95 % intervals of a quantity held the truth.
struct Coverage {
  int held = 0, of = 0;
  [[nodiscard]] double share() const { return static_cast<double>(held) / of; }
};
[[nodiscard]] Coverage CoverageOf(const std::vector<ValidationRow>& rows, Quantity quantity);

// Where that share is not 93 to 97 %, a line that says what sets the scenes that miss the truth
// apart: the warning that they carry most and the others least. Empty where all is well, or where
// there are too few intervals to tell.
[[nodiscard]] std::string WhyMissed(const std::vector<ValidationRow>& rows, Quantity quantity);

}  // namespace bladecurve
