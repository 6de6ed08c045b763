// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bladecurve {

// One line of comma-separated values as RFC 4180 has them, with a newline: fields with a comma, a
// quote or a line end are quoted.
[[nodiscard]] std::string CsvLine(const std::vector<std::string>& fields);

// The rows of a CSV text, quoted fields and either line end understood; empty lines are left out.
// Throws std::invalid_argument for a quote that is never closed.
[[nodiscard]] std::vector<std::vector<std::string>> ParseCsv(std::string_view text);

}  // namespace bladecurve
