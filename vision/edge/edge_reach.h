// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_band.h"

namespace bladecurve {

// How far from an edge its pixels are to be looked at: the levels must be seen beyond the blur, but
// not the next transition. In the background the pixels end before it, in the blade behind it, for
// there it is modelled. inner_px, outer_px: to the next transition, one for each sample.
[[nodiscard]] BandReach ReachBeside(double blur_px,
                                    const std::vector<double>& inner_px,
                                    const std::vector<double>& outer_px);

}  // namespace bladecurve
