// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bladecurve {

// A CSV file of numbers under a line of column names: logs, motions, friction curves.
struct NumberTable {
  std::string source;                        // the file, for messages
  std::vector<std::string> names;            // of the columns
  std::vector<std::vector<double>> columns;  // all of the same length, finite
  std::vector<int> lines;                    // where each row stands in the file, from 1

  [[nodiscard]] std::size_t num_rows() const noexcept { return lines.size(); }

  // nullptr: there is no such column.
  [[nodiscard]] const std::vector<double>* Find(std::string_view name) const noexcept;

  // Throws std::invalid_argument, naming the columns there are, if there is no such column.
  [[nodiscard]] const std::vector<double>& Get(std::string_view name) const;
};

// Reads commas, semicolons or tabs as separators; skips blank lines and lines that begin with '#';
// columns that hold words are left out, cells of a number column must all be finite numbers. Throws
// std::invalid_argument "FILE:LINE: what is wrong" for a file that cannot be read, has no rows, or
// rows of unequal length.
[[nodiscard]] NumberTable ReadNumberTable(const std::filesystem::path& path);

// The same of a text; `source` stands for the file in messages.
[[nodiscard]] NumberTable ParseNumberTable(std::string_view text, const std::string& source);

// The shortest text that reads back exactly; empty for NaN.
[[nodiscard]] std::string NumberText(double value);

}  // namespace bladecurve
