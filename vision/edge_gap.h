// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bladecurve {

// An edge about a line: places along it, ever further, and distances from it towards the edge's own
// side.
struct EdgeAboutLine {
  std::vector<double> along, aside;
};

// How much further from the line the first edge lies than the second, at those places of the first
// that the second has on both sides.
struct EdgeGap {
  std::vector<double> along, apart;
};
[[nodiscard]] EdgeGap GapBetween(const EdgeAboutLine& first, const EdgeAboutLine& second);

}  // namespace bladecurve
