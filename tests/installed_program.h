// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string>

namespace bladecurve {

// Whether the shell finds a program by its name.
[[nodiscard]] inline bool IsInstalled(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace bladecurve
