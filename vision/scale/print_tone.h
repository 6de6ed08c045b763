// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/scale/scale.h"

namespace bladecurve {

// The exponent to sRGB by what the borders of all markers, read with sRGB, tell of it, and by what
// cameras are known to do.
[[nodiscard]] ToneSeen ToneOfPrint(const std::vector<SeenMarker>& markers);

}  // namespace bladecurve
