// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/flag_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace bladecurve {
namespace {

template <typename Number>
Number Parse(const std::string& flag, std::string_view text, const char* kind) {
  // from_chars takes no plus sign; people write one.
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  Number value{};
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc{} || stop != end) {
    throw std::invalid_argument(fmt::format("{}: '{}' is not {}", flag, text, kind));
  }
  return value;
}

}  // namespace

double ParseNumber(const std::string& flag, std::string_view text) {
  const double value = Parse<double>(flag, text, "a number");
  if (!std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{}: '{}' is not a finite number", flag, text));
  }
  return value;
}

int ParseWholeNumber(const std::string& flag, std::string_view text) {
  return Parse<int>(flag, text, "a whole number");
}

std::vector<double> ParseNumbers(const std::string& flag, std::string_view text) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    values.push_back(ParseNumber(flag, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return values;
}

std::vector<double> ParseNumbers(const std::string& flag,
                                 std::string_view text,
                                 std::size_t count,
                                 const std::string& form) {
  std::vector<double> values = ParseNumbers(flag, text);
  if (values.size() != count) {
    throw std::invalid_argument(fmt::format("{}: wants {}, got '{}'", flag, form, text));
  }
  return values;
}

void RequirePositive(const std::string& flag, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{}: must be above zero, got {}", flag, value));
  }
}

void RequireWithin(const std::string& flag, double value, const Bounds& bounds) {
  if (value >= bounds.least && value <= bounds.most) return;
  throw std::invalid_argument(fmt::format(
      "{}: must lie between {} and {}, got {}", flag, bounds.least, bounds.most, value));
}

}  // namespace bladecurve
