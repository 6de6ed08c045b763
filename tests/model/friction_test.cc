// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/friction.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

TEST(FrictionCurve, InterpolatesEachDirectionAndHoldsItsEnds) {
  const FrictionCurve curve({0.1, 0.3}, {1, 3}, {-2, -4});
  EXPECT_DOUBLE_EQ(curve.Closing(0.2), 2);
  EXPECT_DOUBLE_EQ(curve.Opening(0.2), -3);
  EXPECT_EQ(curve.Closing(-1), 1);
  EXPECT_EQ(curve.Opening(9), -4);
}

TEST(FrictionCurve, OfATableReadsDescendingAnglesAndMirrorsAMissingDirection) {
  const FrictionCurve curve =
      FrictionOfTable(ParseNumberTable("theta_deg,closing_n\n20,2\n10,1\n", "f.csv"));
  EXPECT_DOUBLE_EQ(curve.Closing(15 * kDegree), 1.5);
  EXPECT_DOUBLE_EQ(curve.Opening(15 * kDegree), -1.5);
}

TEST(FrictionCurve, RefusesUnsortedAngles) {
  const NumberTable table = ParseNumberTable("theta_deg,closing_n\n10,1\n30,1\n20,1\n", "f.csv");
  EXPECT_THROW(static_cast<void>(FrictionOfTable(table)), std::invalid_argument);
}

TEST(StickSlide, SlidesAtTheCoulombLevelEitherWay) {
  StickSlide friction(0.1);
  static_cast<void>(friction.Step(0, 2));
  EXPECT_DOUBLE_EQ(friction.Step(1, 2), 2);
  EXPECT_DOUBLE_EQ(friction.Step(-1, 2), -2);
}

TEST(StickSlide, SticksElasticallyWithinItsPlay) {
  StickSlide friction(0.1);
  static_cast<void>(friction.Step(0, 2));
  EXPECT_DOUBLE_EQ(friction.Step(0.05, 2), 1);
  EXPECT_DOUBLE_EQ(friction.Step(0, 2), 0);
}

TEST(StickSlide, DoesNotDriftUnderNoiseWithinItsPlay) {
  std::mt19937 random(1);
  StickSlide friction(0.1);
  static_cast<void>(friction.Step(0, 2));
  for (int i = 0; i < 100000; ++i)
    static_cast<void>(friction.Step(Uniform(random, -0.09, 0.09), 2));
  EXPECT_DOUBLE_EQ(friction.Step(0.05, 2), 1);
}

TEST(StickSlide, TakesEnergyOverAnyClosedLoop) {
  std::mt19937 random(2);
  for (int loop = 0; loop < 1000; ++loop) {
    StickSlide friction(0.1);
    double work = 0, x = 0, force = friction.Step(0, 2);
    for (int i = 0; i < 20; ++i) {
      const double target = i == 19 ? 0 : Uniform(random, -1, 1);
      const double step = (target - x) / 400;
      for (int k = 0; k < 400; ++k) {
        const double next = friction.Step(x += step, 2);
        work += 0.5 * (force + next) * step;
        force = next;
      }
    }
    EXPECT_GT(work, 0);
  }
}

}  // namespace
}  // namespace bladecurve
