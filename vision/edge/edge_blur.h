// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_levels.h"

namespace bladecurve {

// Noise of a pixel over the height of the step as the windows see it, at most 1.
[[nodiscard]] double NoisePerContrast(const std::vector<LevelFit>& windows, double noise);

// What a blur may be where `usual_px` is that of the sharper steps nearby: a much wider step is
// another thing than the blade's border, as far as noise let the blur be seen beforehand.
[[nodiscard]] double MostBlur(double usual_px, double noise_per_contrast);

// By how much, px, most of the windows see more blur than their terms were taken at.
[[nodiscard]] double SpreadSeen(const std::vector<LevelFit>& windows);

// The blur that the windows see, their terms being taken at blur_px; at most MostBlur.
[[nodiscard]] double ImprovedBlur(double blur_px,
                                  const std::vector<LevelFit>& windows,
                                  double usual_px,
                                  double noise_per_contrast);

}  // namespace bladecurve
