// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void ThrowCannotWrite(const fs::path& path, const std::string& cause) {
  throw std::runtime_error("cannot write " + path.string() + ": " + cause +
                           "; give a folder that exists and is writable");
}

// The process id keeps two runs that write the same result apart.
fs::path DraftOf(const fs::path& path) {
  return path.string() + "." + std::to_string(getpid()) + ".part";
}

}  // namespace

void WriteFileWhole(const fs::path& path, std::string_view bytes) {
  const fs::path draft = DraftOf(path);
  errno = 0;
  std::ofstream file(draft, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  const std::string cause = file ? "" : std::strerror(errno);
  std::error_code error, ignored;
  if (file) fs::rename(draft, path, error);
  if (file && !error) return;
  fs::remove(draft, ignored);
  ThrowCannotWrite(path, file ? error.message() : cause);
}

void RequireWritable(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) ThrowCannotWrite(path, "it is a folder");
  const fs::path draft = DraftOf(path);
  errno = 0;
  const bool opened = std::ofstream(draft, std::ios::binary).is_open();
  const std::string cause = std::strerror(errno);
  fs::remove(draft, error);
  if (!opened) ThrowCannotWrite(path, cause);
}

}  // namespace bladecurve
