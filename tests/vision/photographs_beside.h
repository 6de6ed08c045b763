// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace bladecurve {

// Where photographs with truth lie that are not the project's own: real/ and rendered/. Tests that
// need them are skipped where they are missing.
inline std::filesystem::path FolderBeside() {
  return std::filesystem::path(BLADECURVE_SOURCE_DIR) / ".." / "shared" / "photos";
}

}  // namespace bladecurve
