// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/number_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace bladecurve {
namespace {

struct Line {
  int number = 0;
  std::vector<std::string_view> cells;
};

[[noreturn]] void Fail(const std::string& source, int line, const std::string& what) {
  throw std::invalid_argument(source + ":" + std::to_string(line) + ": " + what);
}

std::string_view Trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\r' || c == '"'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> Split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t end = line.find(separator); end != std::string_view::npos;
       end = line.find(separator)) {
    cells.push_back(Trimmed(line.substr(0, end)));
    line.remove_prefix(end + 1);
  }
  cells.push_back(Trimmed(line));
  return cells;
}

// The separator that the header uses.
char SeparatorOf(std::string_view header) {
  for (const char separator : {'\t', ';'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

std::vector<Line> SplitLines(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<Line> lines;
  char separator = 0;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = Trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (separator == 0) separator = SeparatorOf(line);
    lines.push_back({number, Split(line, separator)});
  }
  return lines;
}

std::optional<double> NumberOf(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || cell.empty()) return std::nullopt;
  return value;
}

std::vector<double> ParseColumn(const std::vector<Line>& lines,
                                std::size_t index,
                                const std::string& source) {
  std::vector<double> column;
  column.reserve(lines.size() - 1);
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const std::string_view cell = lines[row].cells[index];
    const std::optional<double> value = NumberOf(cell);
    if (!value || !std::isfinite(*value)) {
      const std::string what = cell.empty() ? "nothing" : "\"" + std::string(cell) + "\"";
      Fail(source,
           lines[row].number,
           std::string(lines[0].cells[index]) + " is " + what + ", must be a finite number");
    }
    column.push_back(*value);
  }
  return column;
}

// A column of words (a phase, a name) or an empty one: its first cell is no number.
bool HoldsNumbers(const std::vector<Line>& lines, std::size_t index) {
  return NumberOf(lines[1].cells[index]).has_value();
}

}  // namespace

const std::vector<double>* NumberTable::Find(std::string_view name) const noexcept {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

const std::vector<double>& NumberTable::Get(std::string_view name) const {
  if (const std::vector<double>* column = Find(name)) return *column;
  std::string list;
  for (const std::string& other : names) list += (list.empty() ? "" : ", ") + other;
  Fail(source,
       1,
       "no number column " + std::string(name) + "; there are: " + (list.empty() ? "none" : list));
}

NumberTable ParseNumberTable(std::string_view text, const std::string& source) {
  const std::vector<Line> lines = SplitLines(text);
  if (lines.empty()) Fail(source, 1, "the file is empty; the first line must name the columns");
  if (lines.size() == 1) Fail(source, lines[0].number, "no rows below the column names");
  for (const Line& line : lines) {
    if (line.cells.size() == lines[0].cells.size()) continue;
    Fail(source,
         line.number,
         std::to_string(line.cells.size()) + " cells under " +
             std::to_string(lines[0].cells.size()) + " column names");
  }
  NumberTable table;
  table.source = source;
  for (std::size_t i = 0; i < lines[0].cells.size(); ++i) {
    if (!HoldsNumbers(lines, i)) continue;
    table.names.emplace_back(lines[0].cells[i]);
    table.columns.push_back(ParseColumn(lines, i, source));
  }
  for (std::size_t row = 1; row < lines.size(); ++row) table.lines.push_back(lines[row].number);
  return table;
}

NumberTable ReadNumberTable(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::invalid_argument(path.string() +
                                ": cannot be read; give a CSV file with a line of column names");
  }
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return ParseNumberTable(text, path.string());
}

std::string NumberText(double value) {
  if (std::isnan(value)) return "";
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace bladecurve
