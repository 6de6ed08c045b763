// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_gap.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {

EdgeGap GapBetween(const EdgeAboutLine& first, const EdgeAboutLine& second) {
  EdgeGap gap;
  for (std::size_t i = 0; i < first.along.size(); ++i) {
    const auto after = std::lower_bound(second.along.begin(), second.along.end(), first.along[i]);
    if (after == second.along.begin() || after == second.along.end()) continue;
    const auto k = static_cast<std::size_t>(after - second.along.begin());
    const double t =
        (first.along[i] - second.along[k - 1]) / (second.along[k] - second.along[k - 1]);
    gap.along.push_back(first.along[i]);
    gap.apart.push_back(first.aside[i] - std::lerp(second.aside[k - 1], second.aside[k], t));
  }
  return gap;
}

}  // namespace bladecurve
