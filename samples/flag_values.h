// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bladecurve {

// All throw std::invalid_argument "FLAG: what is wrong, what to give", which main.cc turns into
// exit code 2.

// "1.5,2,-3" as finite numbers, at least one.
[[nodiscard]] std::vector<double> ParseNumbers(const std::string& flag, std::string_view text);

// The same where exactly `count` numbers are wanted; `form` shows them: "X,Y".
[[nodiscard]] std::vector<double> ParseNumbers(const std::string& flag,
                                               std::string_view text,
                                               std::size_t count,
                                               const std::string& form);

[[nodiscard]] double ParseNumber(const std::string& flag, std::string_view text);
[[nodiscard]] int ParseWholeNumber(const std::string& flag, std::string_view text);

// A length, a scale or a factor: finite and above zero.
void RequirePositive(const std::string& flag, double value);

// What no picture, print or pair of scissors exceeds.
struct Bounds {
  double least = 0, most = 0;
};
void RequireWithin(const std::string& flag, double value, const Bounds& bounds);

}  // namespace bladecurve
