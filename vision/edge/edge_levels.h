// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/image/blurred_step.h"

namespace bladecurve {

// The picture beside an edge, linear in its coefficients and seen through the pixel and the blur:
//   blade       L0 + L1 d         (d < 0), and F more beyond a parallel transition inside it (a
//   bevel's inner border) background  B0 + B1 d + B2 d^2  (d > 0)
// and the first-order changes with a shift of the edge, with the blur, and with a shift of the
// inner transition.
enum LevelTerm {
  kBlade,
  kBladeSlope,
  kGround,
  kGroundSlope,
  kGroundBend,
  kShift,
  kSpread,
  kFace,
  kFaceShift,
  kLevelTerms
};

using LevelVector = Eigen::Matrix<double, kLevelTerms, 1>;
using LevelMatrix = Eigen::Matrix<double, kLevelTerms, kLevelTerms>;

// The terms' values at one pixel, its signed distance from the edge being across_px; `face` is the
// blurred step of the inner transition there.
[[nodiscard]] LevelVector LevelTerms(const StepSample& sample,
                                     const StepSample& face,
                                     double across_px,
                                     double blur_variance);

// Weighted normal equations of a stretch of edge; those of two stretches add up.
struct LevelMoments {
  // sum w v v' over the pixels, v being the terms and, last, the light
  Eigen::Matrix<double, kLevelTerms + 1, kLevelTerms + 1> products = decltype(products)::Zero();
  double pixels = 0;  // how many

  void Add(const LevelVector& terms, double light, double weight);
  void Add(const LevelMoments& other, double factor);
};

// The levels of one window along the edge, and what its pixels say about offset and blur.
struct LevelFit {
  LevelVector levels = LevelVector::Zero();
  LevelVector variances = LevelVector::Zero();
  double offset_px = 0;  // of the edge from where the terms were taken, positive out of the blade
  double offset_information = 0;  // 1/px^2, the unknown levels paid for
  double kept_information = 1;    // share of the information left after paying for the levels
  double spread_px = 0;           // change of blur
  double spread_information = 0;  // 1/px^2
  double chi_square_per_pixel = 0;

  [[nodiscard]] double Contrast() const { return levels[kGround] - levels[kBlade]; }
};

// precision: inverse prior variance of each term about zero; 0 leaves it free, kFixed holds it at
// zero.
inline constexpr double kFixed = 1e12;
[[nodiscard]] LevelFit SolveLevels(const LevelMoments& moments, const LevelVector& precision);

// Slopes that the data do not support cost most of the information about the offset. Returns for
// each slope term the prior precision that the fits of many windows suggest: kFixed where neither
// they nor their mean are larger than their own uncertainty. Each pixel lies in `overlap` windows.
[[nodiscard]] LevelVector SlopePrecision(const std::vector<LevelFit>& fits, double overlap);

// How far out of the blade, px, the windows see its inner transition from where it was taken: that
// was read off a coarse grid, where the two push each other apart.
[[nodiscard]] double FaceShift(const std::vector<LevelFit>& windows);

}  // namespace bladecurve
