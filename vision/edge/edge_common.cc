// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_common.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr size_t kStride = 16;  // slices; the levels change slowly

struct Levels {
  double blade = 0, ground = 0;
};

std::vector<Levels> SomeLevels(const EdgeFit& fit) {
  std::vector<Levels> levels;
  for (size_t i = 0; i < fit.slices.size(); i += kStride) {
    const EdgeSlice& slice = fit.slices[i];
    levels.push_back({std::clamp(slice.ground - slice.contrast, kDarkestLight, 1.0),
                      std::clamp(slice.ground, kDarkestLight, 1.0)});
  }
  return levels;
}

// How far light that is taken for half-way between the levels lies off, the exponent of the tone
// curve being off by one sigma.
double ToneSigma(const std::vector<Levels>& levels, double blur_px, double exponent_sigma) {
  constexpr double kLeastSlope = 1e-3;
  const double exponent = 1 + exponent_sigma;
  const double width = std::sqrt(2 * std::numbers::pi * TotalBlurVariance(blur_px));
  std::vector<double> shifts;
  for (const auto& [blade, ground] : levels) {
    const double half =
        std::pow(0.5 * (std::pow(ground, exponent) + std::pow(blade, exponent)), 1 / exponent);
    const double slope = std::abs(ground - blade) / width;
    shifts.push_back((half - 0.5 * (ground + blade)) / std::max(slope, kLeastSlope));
  }
  return MedianAbsolute(std::move(shifts));
}

// Where one side is overexposed its true light is unknown, and the edge creeps towards the other
// side: by twice the blur it then shows where a blade is two or three times too bright. Told from
// the blur, a third of the blur remains.
double BloomSigma(const EdgeFit& fit, bool blur_known) {
  constexpr double kPerApparentBlur = 1.2, kPerBlur = 0.33;
  return fit.overexposed * (blur_known ? kPerBlur : kPerApparentBlur) *
         std::sqrt(TotalBlurVariance(fit.blur_px));
}

}  // namespace

double RivalSigma(const ChosenTransition& chosen) {
  constexpr double kNoRival = 0.45, kShare = 0.6;
  const double doubt = std::max(chosen.ambiguity - kNoRival, 0.0) / (1 - kNoRival);
  return doubt * kShare * std::abs(chosen.rival_px);
}

double SlopeSigma(const EdgeFit& fit) {
  constexpr double kReach = 5, kWrong = 0.35;  // px; share
  std::vector<double> relative;
  for (size_t i = 0; i < fit.slices.size(); i += kStride) {
    const EdgeSlice& slice = fit.slices[i];
    if (slice.contrast != 0) relative.push_back(std::abs(slice.slope / slice.contrast));
  }
  const double wrong = kWrong * kReach * Median(std::move(relative));
  return wrong * std::sqrt(0.5 * std::numbers::pi * TotalBlurVariance(fit.blur_px));
}

double CommonSigma(const EdgeFit& fit,
                   const ToneCurve& tone,
                   const ChosenTransition& chosen,
                   bool blur_known) {
  const std::vector<Levels> levels = SomeLevels(fit);
  return std::hypot(ToneSigma(levels, fit.blur_px, tone.exponent_sigma),
                    BloomSigma(fit, blur_known),
                    std::hypot(RivalSigma(chosen), SlopeSigma(fit)));
}

}  // namespace bladecurve
