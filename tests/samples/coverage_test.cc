// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The whole pipeline on a few rendered scenes: are errors small, and are stated uncertainties true?
// `bladecurve validate --scenes 1000` asks the same of many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "process_folder.h"
#include "samples/validation_run.h"
#include "samples/validation_scene.h"
#include "samples/validation_table.h"

namespace bladecurve {
namespace {

constexpr int kScenes = 8;
constexpr std::uint64_t kSeed = 1;
constexpr double kTwoSided95 = 1.959964;  // standard normal

using Rows = std::vector<ValidationRow>;

Rows Measured() {
  Rows rows;
  for (int number = 0; number < kScenes; ++number) {
    rows.push_back(
        ValidateScene(MakeValidationScene(number, kSeed, Difficulty::kStandard), ProcessFolder()));
  }
  return rows;
}

double MedianError(const Rows& rows, Quantity quantity) {
  std::vector<double> sizes;
  for (const ValidationRow& row : rows) sizes.push_back(row.Of(quantity).size);
  return Percentile(sizes, 0.5);
}

// The goals for standard scenes: half of them must do better.
void ExpectMedianErrorsReachTheGoals(const Rows& rows) {
  EXPECT_LE(MedianError(rows, Quantity::kUpperEdge), 0.1);  // px
  EXPECT_LE(MedianError(rows, Quantity::kLowerEdge), 0.1);  // px
  EXPECT_LE(MedianError(rows, Quantity::kPivot), 1.5);      // px
  EXPECT_LE(MedianError(rows, Quantity::kTheta), 0.05);     // degrees
  EXPECT_LE(MedianError(rows, Quantity::kScale), 300);      // ppm
  EXPECT_LE(MedianError(rows, Quantity::kPhi), 0.02);       // mm
}

// Errors of one scene go together, so a share of so few scattered scenes is rough: where sigmas are
// half of what they should be it is below 70 %.
void ExpectMostIntervalsHoldTheTruth(const Rows& rows) {
  int held = 0, of = 0;
  for (const ValidationRow& row : rows) {
    for (const Quantity quantity : {Quantity::kUpperEdge,
                                    Quantity::kLowerEdge,
                                    Quantity::kPivot,
                                    Quantity::kTheta,
                                    Quantity::kScale,
                                    Quantity::kPhi}) {
      for (const StatedError& stated : row.Of(quantity).stated) {
        ++of;
        held += std::abs(stated.error) <= kTwoSided95 * stated.sigma ? 1 : 0;
      }
    }
  }
  EXPECT_GE(of, 15 * kScenes);
  EXPECT_GE(held, 0.8 * of) << held << " of " << of;
}

// Nor are intervals so wide that they always hold it: pivots scatter over them.
void ExpectIntervalsAreNotMuchTooWide(const Rows& rows) {
  std::vector<double> pivot_sigmas;
  for (const ValidationRow& row : rows) {
    for (const StatedError& stated : row.Of(Quantity::kPivot).stated) {
      pivot_sigmas.push_back(std::abs(stated.error) / stated.sigma);
    }
  }
  EXPECT_GE(Percentile(pivot_sigmas, 1), 0.8);  // largest of 16
}

// One test, for every test renders its scenes anew.
TEST(ValidateScene, MeasuresStandardScenesWithinTheGoalsAndItsSigmas) {
  const Rows rows = Measured();
  for (const ValidationRow& row : rows) ASSERT_TRUE(row.measured()) << row.scene << row.detail;
  ExpectMedianErrorsReachTheGoals(rows);
  ExpectMostIntervalsHoldTheTruth(rows);
  ExpectIntervalsAreNotMuchTooWide(rows);
}

// Scenes of seed 7 that were once refused or measured about a wrong pivot.
struct HardScene {
  int number;
  const char* what;
};
constexpr HardScene kHardScenes[] = {
    {276, "a faint head among clutter, off the overlap's middle"},
    {861, "a head further forward than most"},
    {884, "a bevel's inner border, by which the edges meet at the pivot like a clamp's jaws"},
};

TEST(ValidateScene, MeasuresHardScenes) {
  constexpr std::uint64_t kHardSeed = 7;
  constexpr double kClosePx = 0.5, kCloseDeg = 0.2;
  for (const HardScene& hard : kHardScenes) {
    const ValidationRow row = ValidateScene(
        MakeValidationScene(hard.number, kHardSeed, Difficulty::kStandard), ProcessFolder());
    ASSERT_TRUE(row.measured()) << hard.what << ": " << row.detail;
    EXPECT_LT(row.Of(Quantity::kPivot).size, kClosePx) << hard.what;
    EXPECT_LT(row.Of(Quantity::kTheta).size, kCloseDeg) << hard.what;
  }
}

// In the middle of a shadow lie lines of the drape's weave, clear and faint: one was taken for the
// shadow's border, and that for the blade's, 18 px off.
TEST(ValidateScene, TakesNoLineOfTheWeaveForABorder) {
  constexpr double kClosePx = 1;
  const ValidationRow row =
      ValidateScene(MakeValidationScene(254, 4004, Difficulty::kSun), ProcessFolder());
  ASSERT_TRUE(row.measured()) << row.detail;
  EXPECT_LT(row.Of(Quantity::kUpperEdge).size, kClosePx);
}

}  // namespace
}  // namespace bladecurve
