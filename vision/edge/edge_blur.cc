// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_blur.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/image/robust_statistics.h"

namespace bladecurve {

double NoisePerContrast(const std::vector<LevelFit>& windows, double noise) {
  std::vector<double> contrasts;
  for (const LevelFit& window : windows) contrasts.push_back(std::abs(window.Contrast()));
  return std::min(noise / std::max(Median(std::move(contrasts)), 1e-12), 1.0);
}

double MostBlur(double usual_px, double noise_per_contrast) {
  // Noise being as high as the step, a blur of 4 looks like one of 1.
  constexpr double kMostShare = 1.5, kPerNoise = 3;
  constexpr double kMargin = 0.25;  // px
  return (kMostShare + kPerNoise * noise_per_contrast) * usual_px + kMargin;
}

double SpreadSeen(const std::vector<LevelFit>& windows) {
  std::vector<std::pair<double, double>> spreads;
  for (const LevelFit& window : windows) {
    spreads.emplace_back(window.spread_px,
                         window.spread_information / std::max(window.chi_square_per_pixel, 1.0));
  }
  return WeightedMedian(std::move(spreads));
}

double ImprovedBlur(double blur_px,
                    const std::vector<LevelFit>& windows,
                    double usual_px,
                    double noise_per_contrast) {
  constexpr double kLeastShare = 0.5;
  constexpr double kPriorInformation =
      30;  // 1/px^2; windows that know less together do not change the blur
  std::vector<std::pair<double, double>> steps{{usual_px - blur_px, kPriorInformation}};
  for (const LevelFit& window : windows) {
    steps.emplace_back(window.spread_px,
                       window.spread_information / std::max(window.chi_square_per_pixel, 1.0));
  }
  const double step = std::clamp(WeightedMedian(std::move(steps)), -0.4 * blur_px, 0.6 * blur_px);
  return std::min(std::max(blur_px + step, kLeastShare * usual_px),
                  MostBlur(usual_px, noise_per_contrast));
}

}  // namespace bladecurve
