// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_rows_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<fs::path> RowFiles(const fs::path& out) {
  std::vector<fs::path> files;
  if (!fs::is_directory(out / "rows")) return files;
  for (const auto& entry : fs::directory_iterator(out / "rows")) {
    if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool EndsInsideALine(const fs::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() <= 0) return false;
  file.seekg(-1, std::ios::end);
  return file.get() != '\n';
}

}  // namespace

std::vector<Json> ReadRows(const fs::path& out) {
  std::vector<Json> rows;
  for (const fs::path& path : RowFiles(out)) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      Json row = Json::parse(line, nullptr, /*allow_exceptions=*/false);
      if (row.is_object() && row.contains("key")) rows.push_back(std::move(row));
    }
  }
  return rows;
}

RowWriter::RowWriter(const fs::path& out, const Shard& shard)
    : path_(out / "rows" / fmt::format("{}-of-{}.jsonl", shard.index, shard.count)) {
  fs::create_directories(path_.parent_path());
  const bool mend = EndsInsideALine(path_);
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0 || (mend && write(descriptor_, "\n", 1) != 1)) {
    throw std::runtime_error(fmt::format(
        "cannot write {}: {}; give an OUT that is writable", path_.string(), std::strerror(errno)));
  }
}

RowWriter::~RowWriter() { close(descriptor_); }

void RowWriter::Append(const Json& row) {
  const std::string line = row.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  const std::lock_guard lock(mutex_);
  if (write(descriptor_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    throw std::runtime_error(fmt::format(
        "cannot write {}: {}; make room on the disk", path_.string(), std::strerror(errno)));
  }
}

}  // namespace bladecurve
