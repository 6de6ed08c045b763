// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_reach.h"

#include <algorithm>
#include <cmath>

#include "vision/image/blurred_step.h"

namespace bladecurve {
namespace {

double WantedReach(double blur_px) {
  constexpr double kReachPerBlur = 5, kLeast = 5, kMost = 14;
  return std::clamp(kReachPerBlur * std::sqrt(TotalBlurVariance(blur_px)), kLeast, kMost);
}

}  // namespace

BandReach ReachBeside(double blur_px,
                      const std::vector<double>& inner_px,
                      const std::vector<double>& outer_px) {
  constexpr double kBehind = 2, kBefore = 1, kLeastOuter = 1.5;
  const double wanted = WantedReach(blur_px);
  BandReach reach;
  for (const double inner : inner_px) reach.inner_px.push_back(std::min(inner + kBehind, wanted));
  for (const double outer : outer_px)
    reach.outer_px.push_back(std::clamp(outer - kBefore, kLeastOuter, wanted));
  return reach;
}

}  // namespace bladecurve
