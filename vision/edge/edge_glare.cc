// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_glare.h"

#include <algorithm>

namespace bladecurve {
namespace {

// A stop above white, give or take one, and even.
void AddSide(int sample, LevelTerm level, LevelTerm slope, EdgeWindows* windows) {
  constexpr double kUsual = 2, kSigma = 1;  // of white
  constexpr double kSlopeSigma = 0.02;      // of white, per px
  LevelVector terms = LevelVector::Zero();
  terms[level] = 1;
  windows->Add(sample, terms, kUsual, 1 / (kSigma * kSigma));
  terms[level] = 0;
  terms[slope] = 1;
  windows->Add(sample, terms, 0, 1 / (kSlopeSigma * kSlopeSigma));
}

}  // namespace

double Glare::Weight(int sample, double step, const SideNoise& noise) const {
  constexpr double kModelError = 0.01;  // linear light; blur is no Gaussian to the last percent
  if (!At(sample)) return noise.Weight(step);
  const double seen = where_.OfBlade(sample) ? noise.ground : noise.blade;
  return 1 / (seen * seen + kModelError * kModelError);
}

void Glare::HideWhite(const std::optional<LevelVector>& levels,
                      std::vector<PreparedPixel>* pixels) {
  constexpr double kNearlyWhite = 0.15;  // linear light; noise and compression stay within
  for (PreparedPixel& pixel : *pixels) {
    const double expected = levels ? levels->dot(pixel.terms) : pixel.light;
    if (std::max(expected, pixel.light - kNearlyWhite) > Overexposure::kTrusted) pixel.weight = 0;
  }
}

void Glare::AddUnknownLight(int sample, EdgeWindows* windows) const {
  if (where_.OfBlade(sample)) AddSide(sample, kBlade, kBladeSlope, windows);
  if (where_.OfGround(sample)) AddSide(sample, kGround, kGroundSlope, windows);
}

}  // namespace bladecurve
