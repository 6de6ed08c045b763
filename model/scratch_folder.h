// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace bladecurve {

// A folder of its own that disappears again.
class ScratchFolder {
 public:
  // Throws std::runtime_error that begins with `who` if there is no room for one.
  explicit ScratchFolder(const std::string& who) {
    namespace fs = std::filesystem;
    std::string name = (fs::temp_directory_path() / "bladecurve-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error(who + ": no temporary folder in " +
                               fs::temp_directory_path().string() + ": " + std::strerror(errno) +
                               "; set TMPDIR to one that is writable");
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;  // what cannot be removed is left to the system
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace bladecurve
