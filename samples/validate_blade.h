// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace bladecurve {

// Draws the edge that a .blade.json describes into each of its photographs, in that photograph's
// pose, and says in words how far the photograph's own edge lies from it. Photographs are looked
// for where the file says, then beside the file. Throws std::invalid_argument where the file names
// no photographs or one has changed, Refused where one cannot be read.
[[nodiscard]] std::string CompareBladeWithPhotographs(const std::filesystem::path& blade);

}  // namespace bladecurve
