// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_levels.h"

namespace bladecurve {

// Noise of a pixel over the height of the step as the windows see it, at most 1.
[[nodiscard]] double NoisePerContrast(const std::vector<LevelFit>& windows, double noise);

// The blur that the windows see, their terms being taken at blur_px. usual_px: of the sharper steps
// in the edge's neighbourhood.
[[nodiscard]] double ImprovedBlur(double blur_px,
                                  const std::vector<LevelFit>& windows,
                                  double usual_px,
                                  double noise_per_contrast);

}  // namespace bladecurve
