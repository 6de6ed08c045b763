// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/csv_text.h"

#include <stdexcept>
#include <utility>

namespace bladecurve {
namespace {

std::string Quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string quoted(1, '"');
  for (const char c : field) quoted.append(c == '"' ? 2 : 1, c);
  return quoted.append(1, '"');
}

// Reads one character after the other.
class CsvReader {
 public:
  void Take(char c) {
    if (in_quotes_) {
      TakeQuoted(c);
    } else if (c == '"' && field_.empty()) {
      in_quotes_ = true;
    } else if (c == ',') {
      EndField();
    } else if (c == '\n') {
      EndRow();
    } else if (c != '\r') {
      EndQuotes();
      field_ += c;
    }
  }

  std::vector<std::vector<std::string>> Finish() {
    if (in_quotes_ && !quote_pending_) throw std::invalid_argument("CSV: a quote is never closed");
    EndRow();
    return std::move(rows_);
  }

 private:
  // Inside quotes, two quotes are one; one quote ends them.
  void TakeQuoted(char c) {
    if (!quote_pending_) {
      if (c == '"') {
        quote_pending_ = true;
      } else {
        field_ += c;
      }
      return;
    }
    quote_pending_ = false;
    if (c == '"') {
      field_ += c;
      return;
    }
    in_quotes_ = false;
    Take(c);
  }

  void EndQuotes() { in_quotes_ = quote_pending_ = false; }

  void EndField() {
    EndQuotes();
    row_.push_back(std::move(field_));
    field_.clear();
  }

  void EndRow() {
    if (row_.empty() && field_.empty()) return EndQuotes();
    EndField();
    rows_.push_back(std::move(row_));
    row_.clear();
  }

  std::vector<std::vector<std::string>> rows_;
  std::vector<std::string> row_;
  std::string field_;
  bool in_quotes_ = false, quote_pending_ = false;
};

}  // namespace

std::string CsvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    line += Quoted(fields[i]);
  }
  return line + '\n';
}

std::vector<std::vector<std::string>> ParseCsv(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets write one
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  CsvReader reader;
  for (const char c : text) reader.Take(c);
  return reader.Finish();
}

}  // namespace bladecurve
