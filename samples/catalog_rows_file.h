// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "samples/shard.h"

namespace bladecurve {

// All rows below OUT/rows, of whatever shards, in the order of file names and lines. A last line
// that a killed run left half written is passed over.
[[nodiscard]] std::vector<nlohmann::ordered_json> ReadRows(const std::filesystem::path& out);

// Appends rows to OUT/rows/<i>-of-<N>.jsonl, each by one write of the system: a killed process
// loses no finished row. Invariant: the file is open and ends with a line end. Threads may share
// it.
class RowWriter {
 public:
  RowWriter(const std::filesystem::path& out, const Shard& shard);  // throws std::runtime_error
  ~RowWriter();
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  void Append(const nlohmann::ordered_json& row);

 private:
  std::filesystem::path path_;
  std::mutex mutex_;
  int descriptor_;
};

}  // namespace bladecurve
