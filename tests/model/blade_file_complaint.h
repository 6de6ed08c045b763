// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "model/blade_file.h"

namespace bladecurve {

// What is wrong with a blade file or plugin; empty if it can be read.
[[nodiscard]] inline std::string BladeFileComplaint(const std::filesystem::path& path) {
  try {
    static_cast<void>(ReadBladeFile(path));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace bladecurve
