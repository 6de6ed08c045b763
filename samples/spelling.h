// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bladecurve {

// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other
// (Damerau-Levenshtein, optimal string alignment).
[[nodiscard]] int EditDistance(std::string_view a, std::string_view b);

// The candidate nearest to `word`; empty where none is near enough to be what was meant: more than
// a third of the letters differ.
[[nodiscard]] std::string NearestName(std::string_view word,
                                      const std::vector<std::string>& candidates);

}  // namespace bladecurve
