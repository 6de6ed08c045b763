// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Which slopes beside an edge its windows support.
#include "vision/edge_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

constexpr int kWindows = 37;    // of an edge of 300 px
constexpr int kStretches = 13;  // of a window; the next one begins two further on
constexpr double kOverlap = kStretches / 2.0;

// Windows that see nothing but noise, of variance one, and the slopes `mean` gives.
std::vector<LevelFit> NoisyWindows(testing::Gaussian& random,
                                   const std::function<double(int window)>& mean) {
  std::vector<double> stretches(2 * kWindows + kStretches);
  for (double& stretch : stretches) stretch = random();
  std::vector<LevelFit> fits(kWindows);
  for (int w = 0; w < kWindows; ++w) {
    double sum = 0;
    for (int k = 0; k < kStretches; ++k) sum += stretches[static_cast<size_t>(2 * w + k)];
    LevelFit& fit = fits[static_cast<size_t>(w)];
    fit.variances.setOnes();
    fit.levels.setZero();
    fit.levels[kGroundSlope] = sum / std::sqrt(kStretches) + mean(w);
  }
  return fits;
}

double SupportedShare(const std::function<double(int window)>& mean) {
  constexpr int kDraws = 20000;
  testing::Gaussian random(1);
  int supported = 0;
  for (int draw = 0; draw < kDraws; ++draw)
    supported += SlopePrecision(NoisyWindows(random, mean), kOverlap)[kGroundSlope] < kFixed;
  return static_cast<double>(supported) / kDraws;
}

// A slope that noise feigns costs an edge half of what is known about its place.
TEST(SlopePrecision, SeldomTakesNoiseForSlopes) {
  constexpr double kSeldom = 0.003;
  EXPECT_LT(SupportedShare([](int) { return 0.0; }), kSeldom);
}

TEST(SlopePrecision, KeepsWhatAllWindowsShareHoweverLittleEachSeesOfIt) {
  constexpr double kShared = 1.9;  // sigmas of one window
  EXPECT_GT(SupportedShare([](int) { return kShared; }), 0.85);
}

TEST(SlopePrecision, KeepsWhatChangesAlongTheEdge) {
  constexpr double kSwing = 3;  // sigmas of one window
  EXPECT_GT(SupportedShare([](int w) { return w < kWindows / 2 ? kSwing : -kSwing; }), 0.95);
}

}  // namespace
}  // namespace bladecurve
