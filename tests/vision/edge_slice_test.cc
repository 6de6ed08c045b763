// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

using testing::Gaussian;

constexpr double kBlur = 0.8;
constexpr double kSliceNoise = 0.004;

LevelVector WindowLevels() {
  LevelVector levels = LevelVector::Zero();
  levels[kBlade] = 0.2;
  levels[kGround] = 0.6;
  return levels;
}

// A slice of an edge that lies `offset` out of the path, its sides straying from their window's
// levels.
std::vector<PreparedPixel> Slice(double offset, double blade, double ground, Gaussian* noise) {
  const BlurredStep step(Eigen::Vector2d(0.8, 0.6), kBlur);
  const LevelVector levels = WindowLevels();
  std::vector<PreparedPixel> pixels;
  for (double across = -6.3; across <= 6; ++across) {
    const StepSample sample = step.At(across), seen = step.At(across - offset);
    PreparedPixel pixel;
    pixel.terms = LevelTerms(sample, StepSample{1, 0, 0}, across, TotalBlurVariance(kBlur));
    pixel.light = (levels[kBlade] + blade) * (1 - seen.step) +
                  (levels[kGround] + ground) * seen.step +
                  (noise != nullptr ? kSliceNoise * (*noise)() : 0.0);
    pixel.weight = 1 / (kSliceNoise * kSliceNoise);
    pixels.push_back(pixel);
  }
  return pixels;
}

TEST(SolveSlice, FindsTheOffsetWhereBothSidesStray) {
  constexpr double kFirstOrder = 0.006;  // px; the expansion's error at an offset of 0.1 px
  constexpr double kPull = 0.004;        // px; towards the neighbours
  const SliceTexture texture{0.05, 0.05};
  for (const double offset : {-0.1, 0.0, 0.1}) {
    for (const double blade : {-0.06, 0.0, 0.06}) {
      const EdgeSlice slice =
          SolveSlice(Slice(offset, blade, -blade, nullptr), WindowLevels(), texture, 1);
      EXPECT_NEAR(slice.offset_px, offset, kFirstOrder + kPull) << "blade strays by " << blade;
    }
  }
}

TEST(SolveSlice, AFacetAsFarOffAsAnotherMetalIsFollowed) {
  constexpr double kTolerance = 0.05;  // px; taken for texture it would be 0.5 px
  const SliceTexture texture{0.01, 0.01};
  const EdgeSlice slice = SolveSlice(Slice(0, 0.2, 0, nullptr), WindowLevels(), texture, 1);
  EXPECT_NEAR(slice.offset_px, 0, kTolerance);
  EXPECT_NEAR(slice.contrast, 0.2, 0.02);
}

TEST(SolveSlice, ItsSigmaIsItsScatter) {
  constexpr int kDraws = 400;
  Gaussian random(5);
  double squares = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const EdgeSlice slice = SolveSlice(
        Slice(0, 0.03 * random(), 0.03 * random(), &random), WindowLevels(), {0.03, 0.03}, 1);
    squares += std::pow(slice.offset_px / slice.sigma_px, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kDraws), 1, 0.12);  // rms of 400 draws scatters by 4 %
}

TEST(TextureSigma, IsWhatNoiseDoesNotExplain) {
  constexpr int kSlices = 2000;
  constexpr double kPixels = 5, kTexture = 0.02;
  Gaussian random(6);
  std::vector<SideRest> noisy, textured;
  for (int i = 0; i < kSlices; ++i) {
    const double mean = kSliceNoise / std::sqrt(kPixels) * random();
    noisy.push_back({mean, kPixels});
    textured.push_back({mean + kTexture * random(), kPixels});
  }
  EXPECT_LT(TextureSigma(noisy, kSliceNoise), 0.2 * kSliceNoise);
  EXPECT_NEAR(TextureSigma(textured, kSliceNoise), kTexture, 0.1 * kTexture);
  EXPECT_EQ(TextureSigma({}, kSliceNoise), 0);
}

// Slices of noise, held to zero as far as SolveSlice holds what says so little.
std::vector<EdgeSlice> QuietSlices(double offset, double held) {
  constexpr int kSlices = 200;
  Gaussian random(5);
  std::vector<EdgeSlice> slices(kSlices);
  for (EdgeSlice& slice : slices) {
    slice.held = held;
    slice.offset_px = (1 - held) * (offset + 0.5 * random());
  }
  return slices;
}

TEST(HoldToNeighbours, TheMeanIsAsIfNoSliceHadBeenHeld) {
  constexpr double kOffset = 0.4;
  for (const double held : {0.05, 0.5, 0.9}) {
    std::vector<EdgeSlice> slices = QuietSlices(kOffset, held);
    double free = 0, found = 0;
    for (const EdgeSlice& slice : slices) free += slice.offset_px / (1 - held);
    HoldToNeighbours(1, &slices);
    for (const EdgeSlice& slice : slices) found += slice.offset_px;
    // The little weight of the path, 0.01 against 0.44 at least, is all that pulls.
    EXPECT_NEAR(found / free, 1, 0.03) << "held " << held;
  }
}

TEST(HoldToNeighbours, WhereNothingIsSeenThePathStands) {
  std::vector<EdgeSlice> slices(50);
  for (EdgeSlice& slice : slices) slice.held = 1;
  HoldToNeighbours(1, &slices);
  for (const EdgeSlice& slice : slices) EXPECT_EQ(slice.offset_px, 0);
}

}  // namespace
}  // namespace bladecurve
