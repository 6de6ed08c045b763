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

double ImprovedBlur(double blur_px,
                    const std::vector<LevelFit>& windows,
                    double usual_px,
                    double noise_per_contrast) {
  // A much wider step is another thing than the blade's border, as far as noise let the blur be
  // seen beforehand: noise being as high as the step, a blur of 4 looks like one of 1.
  constexpr double kLeastShare = 0.5, kMostShare = 1.5, kPerNoise = 3;
  constexpr double kMargin = 0.25;  // px
  constexpr double kPriorInformation =
      30;  // 1/px^2; windows that know less together do not change the blur
  std::vector<std::pair<double, double>> steps{{usual_px - blur_px, kPriorInformation}};
  for (const LevelFit& window : windows) {
    steps.emplace_back(window.spread_px,
                       window.spread_information / std::max(window.chi_square_per_pixel, 1.0));
  }
  const double step = std::clamp(WeightedMedian(std::move(steps)), -0.4 * blur_px, 0.6 * blur_px);
  const double most_share = kMostShare + kPerNoise * noise_per_contrast;
  const double most = most_share * usual_px + kMargin;
  return std::min(std::max(blur_px + step, kLeastShare * usual_px), most);
}

}  // namespace bladecurve
