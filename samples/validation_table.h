// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "samples/validation_run.h"

namespace bladecurve {

// Name and unit of a quantity: "theta", "deg".
[[nodiscard]] const char* QuantityName(Quantity quantity);
[[nodiscard]] const char* QuantityUnit(Quantity quantity);

// For people: errors (median, 95th percentile), coverage of the 95 % intervals, refusals right and
// wrong with their reasons, run time.
[[nodiscard]] std::string ValidationTable(const std::vector<ValidationRow>& rows, bool with_times);

// One line a scene; without times the same scenes give the same bytes.
[[nodiscard]] std::string ValidationCsv(const std::vector<ValidationRow>& rows, bool with_times);

// Smallest value that at least `share` of the values do not exceed; NaN of none. NaN values are
// left out.
[[nodiscard]] double Percentile(std::vector<double> values, double share);

}  // namespace bladecurve
