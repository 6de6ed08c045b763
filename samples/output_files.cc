// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace bladecurve {
namespace {

[[noreturn]] void ThrowCannotWrite(const std::filesystem::path& path, const std::string& cause) {
  throw std::runtime_error(fmt::format(
      "cannot write {}: {}; give a folder that exists and is writable", path.string(), cause));
}

}  // namespace

void WriteFileWhole(const std::filesystem::path& path, std::string_view text) {
  // The process id keeps two runs that write the same result apart.
  const std::filesystem::path draft = path.string() + fmt::format(".{}.part", getpid());
  errno = 0;
  std::ofstream file(draft, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) ThrowCannotWrite(path, std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(draft, path, error);
  if (error) ThrowCannotWrite(path, error.message());
}

}  // namespace bladecurve
