// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge_levels.h"

namespace bladecurve {

// What is expected of an edge's blur before it is measured.
struct BlurExpectation {
  double usual_px = 0.9;  // of the sharper steps in its neighbourhood
  double most_px = 1e3;   // no more, whatever the edge looks like
};

// Noise of a pixel over the height of the step as the windows see it, at most 1.
[[nodiscard]] double NoisePerContrast(const std::vector<LevelFit>& windows, double noise);

// The blur that the windows see, their terms being taken at blur_px.
[[nodiscard]] double ImprovedBlur(double blur_px,
                                  const std::vector<LevelFit>& windows,
                                  const BlurExpectation& expected,
                                  double noise_per_contrast);

}  // namespace bladecurve
