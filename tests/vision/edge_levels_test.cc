// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Which slopes beside an edge its windows support.
#include "vision/edge/edge_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

constexpr int kUsual = 37;      // windows of an edge of 300 px
constexpr int kStretches = 13;  // of a window; the next one begins two further on
constexpr double kOverlap = kStretches / 2.0;

// Windows that see nothing but noise, of variance one, and the slopes `mean` gives.
std::vector<LevelFit> NoisyWindows(int windows,
                                   testing::Gaussian& random,
                                   const std::function<double(int window)>& mean) {
  std::vector<double> stretches(static_cast<size_t>(2 * windows + kStretches));
  for (double& stretch : stretches) stretch = random();
  std::vector<LevelFit> fits(static_cast<size_t>(windows));
  for (int w = 0; w < windows; ++w) {
    double sum = 0;
    for (int k = 0; k < kStretches; ++k) sum += stretches[static_cast<size_t>(2 * w + k)];
    LevelFit& fit = fits[static_cast<size_t>(w)];
    fit.variances.setOnes();
    fit.levels.setZero();
    fit.levels[kGroundSlope] = sum / std::sqrt(kStretches) + mean(w);
  }
  return fits;
}

double SupportedShare(int windows, const std::function<double(int window)>& mean) {
  constexpr int kDraws = 20000;
  testing::Gaussian random(1);
  int supported = 0;
  for (int draw = 0; draw < kDraws; ++draw)
    supported +=
        SlopePrecision(NoisyWindows(windows, random, mean), kOverlap)[kGroundSlope] < kFixed;
  return static_cast<double>(supported) / kDraws;
}

// A slope that noise feigns costs an edge half of what is known about its place.
TEST(SlopePrecision, TakesNoiseForSlopesAsSeldomWhateverTheLength) {
  constexpr double kLeast = 0.001, kMost = 0.003;  // less would miss faint slopes
  for (const int windows : {3, 9, kUsual, 100}) {
    const double share = SupportedShare(windows, [](int) { return 0.0; });
    EXPECT_LT(share, kMost) << windows;
    EXPECT_GT(share, kLeast) << windows;
  }
}

TEST(SlopePrecision, KeepsWhatAllWindowsShareHoweverLittleEachSeesOfIt) {
  constexpr double kShared = 1.9;  // sigmas of one window
  EXPECT_GT(SupportedShare(kUsual, [](int) { return kShared; }), 0.85);
}

TEST(SlopePrecision, KeepsWhatChangesAlongTheEdge) {
  constexpr double kSwing = 3;  // sigmas of one window
  EXPECT_GT(SupportedShare(kUsual, [](int w) { return w < kUsual / 2 ? kSwing : -kSwing; }), 0.95);
}

}  // namespace
}  // namespace bladecurve
