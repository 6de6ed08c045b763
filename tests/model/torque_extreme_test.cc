// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Extreme and stiff cases, each over seeded random input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"
#include "tests/model/extreme_checks.h"

namespace bladecurve {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Whether the edge has no other contact at this level between where the crack was and where it is.
bool IsFirstContact(const BladeCurve& blade,
                    const TorqueSample& now,
                    double theta_rad,
                    double before_mm) {
  const double level_mm = blade.Eval(now.x_c_mm, theta_rad).phi_mm;
  constexpr double kSlack_mm = 1e-6;  // of the contact itself
  for (double x_mm = before_mm; x_mm < now.x_c_mm - kSlack_mm; x_mm += 0.01) {
    if (blade.Eval(x_mm, theta_rad).phi_mm > level_mm + kSlack_mm) return false;
  }
  return true;
}

// Follows a closing motion: flagged samples hold the last valid torque or less.
int CountSaturated(TorqueModel model, const std::string& scene) {
  double valid_nmm = 0;
  int flagged = 0;
  for (const Pose& pose : StraightMotion(60, 0, 600)) {
    const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
    ExpectFinite(sample, scene);
    if ((sample.flags & kTorqueCannotCut) == 0) {
      valid_nmm = sample.torque_nmm;
    } else {
      EXPECT_LE(sample.torque_nmm, valid_nmm) << scene;
      ++flagged;
    }
  }
  return flagged;
}

TEST(TorqueModelExtremes, ABladeThatCannotCutKeepsItsLastValidTorqueAndIsFlagged) {
  std::mt19937 random(1);
  int flagged = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double b = Uniform(random, -0.3, 0.05);  // the slope reaches zero while the blades close
    const BladeCurve tapered(TaperedRectangle{Uniform(random, -6, 1), b, 0.5}, {0, 1e6, 0, 1.2});
    const BladeCurve wavy = RandomWavyBlade(random);
    const Material material = PaperMaterials()[random() % 4];
    flagged += CountSaturated(TorqueModel(tapered, material, kCutSpan), "b = " + std::to_string(b));
    flagged +=
        CountSaturated(TorqueModel(wavy, material, {25, 75}), "trial " + std::to_string(trial));
  }
  EXPECT_GT(flagged, 200);
}

TEST(TorqueModelExtremes, AnyAngleGivesAFiniteTorqueAndAFlagOutsideTheDomain) {
  std::mt19937 random(2);
  const double angles[] = {
      0, -1e-9, -0.3, -1, -3.2, 1.2, 3.14159265, 3.15, 7, 1e3, -1e6, 1e12, -1e300};
  for (int trial = 0; trial < 300; ++trial) {
    const BladeCurve blade = trial % 2 == 0 ? SmallMetzenbaum() : CurvedBlade();
    TorqueModel model(blade, PaperMaterials()[static_cast<std::size_t>(trial % 4)], kCutSpan);
    for (int i = 0; i < 20; ++i) {
      const double theta =
          random() % 2 == 0 ? Uniform(random, -0.5, 1.5) : angles[random() % std::size(angles)];
      const TorqueSample sample = model.Step(theta, 0, 1e-3);
      ExpectFinite(sample, "theta = " + std::to_string(theta));
      EXPECT_EQ((sample.flags & kCurveThetaOutside) != 0, theta < 0 || theta > 1.2) << theta;
    }
  }
}

TEST(TorqueModelExtremes, TheTipIsReachedBeforeThePole) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 50; ++trial) {
    const double b = Uniform(random, 0.02, 0.25);
    const double pole_rad = 2 * std::atan(-2 * b);  // the zero of s = b + tan(theta/2)/2
    const BladeCurve blade(TaperedRectangle{-11, b, 0.5}, {0, 80, -1, 1.2});
    TorqueModel model(blade, PaperMaterials()[0], {Uniform(random, 40, 60), 1000});
    TorqueSample sample;
    for (const Pose& pose : StraightMotion(68, pole_rad / kDegree, 1000)) {
      sample = model.Step(pose.theta_rad, 0, 1e-3);
      ExpectFinite(sample, "b = " + std::to_string(b));
      // At the blade's end s is 11/80, whatever b, and tau_c 72 N mm; the pole would be beyond it.
      EXPECT_LT(sample.torque_nmm, 80) << "b = " << b;
    }
    EXPECT_EQ(sample.phase, Phase::kNone);
    EXPECT_EQ(sample.torque_nmm, 0);
    EXPECT_NE(sample.flags & kTorqueBeyondBlade, 0u);
  }
}

TEST(TorqueModelExtremes, TorqueFadesSmoothlyAtBothEndsOfTheBlade) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 40; ++trial) {
    const bool withdrawn = trial % 2 == 0;  // beyond the blade's end; or the pivot comes up
    const double edge_mm = Uniform(random, 30, 45);
    const double to_mm = withdrawn ? -120 : edge_mm + Uniform(random, 1, 20);
    TorqueModel model(BladeCurve(TaperedRectangle{-11, 0.14, 0.5}, {0, 80, 0, 1.2}),
                      {"tough", 1e9, 0.1, ForceDeflection(LogUniform(random, 1e-3, 1e3))},
                      {edge_mm, edge_mm + 20});
    const double theta_rad = Uniform(random, 0, 10) * kDegree;
    std::vector<double> torques_nmm;
    const int steps = 40000;
    for (int i = 0; i <= steps; ++i) {
      const TorqueSample sample = model.Step(theta_rad, to_mm * i / steps, 1e-3);
      ExpectFinite(sample, "pivot");
      torques_nmm.push_back(sample.torque_nmm);
    }
    const double largest_nmm = *std::max_element(torques_nmm.begin(), torques_nmm.end());
    ASSERT_GT(largest_nmm, 0);
    for (std::size_t i = 1; i < torques_nmm.size(); ++i) {
      EXPECT_LT(std::abs(torques_nmm[i] - torques_nmm[i - 1]), 0.01 * largest_nmm)
          << "trial " << trial << ": a jump at pivot " << to_mm * static_cast<double>(i) / steps;
    }
    EXPECT_EQ(torques_nmm.back(), 0);
  }
}

TEST(TorqueModelExtremes, TheCrackFollowsOneContactAndJumpsOnlyWhereThatEnds) {
  std::mt19937 random(5);
  int jumps = 0;
  for (int trial = 0; trial < 60; ++trial) {
    TorqueModel model(RandomWavyBlade(random), PaperMaterials()[random() % 4], {25, 75});
    const int steps = 100 + static_cast<int>(random() % 3000);
    double crack_mm = 25;
    for (const Pose& pose : StraightMotion(35, 0, steps)) {
      const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
      ExpectFinite(sample, "wavy blade");
      EXPECT_GE(sample.x_c_mm, crack_mm) << "the crack healed";
      bool jumped = false;
      for (const TorqueEvent& event : model.events())
        jumped |= event.kind == TorqueEventKind::kSnap;
      jumps += jumped;
      const bool cuts = sample.phase == Phase::kCutting && (sample.flags & kTorqueCannotCut) == 0;
      if (cuts) {
        EXPECT_GT(model.blade().Eval(sample.x_c_mm, pose.theta_rad).phi_x, 0);
        EXPECT_TRUE(jumped || IsFirstContact(model.blade(), sample, pose.theta_rad, crack_mm))
            << "trial " << trial << ": passed over a contact at " << pose.theta_rad;
      }
      crack_mm = sample.x_c_mm;
    }
  }
  EXPECT_GT(jumps, 20) << "hardly an edge dips";
}

TEST(TorqueModelExtremes, EncoderNoiseAloneCutsNothing) {
  std::mt19937 random(6);
  const double count_rad = 0.01 * kDegree;
  for (int trial = 0; trial < 100; ++trial) {
    const DeltaPolicy policy = trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion;
    TorqueModel model(SmallMetzenbaum(),
                      PaperMaterials()[static_cast<std::size_t>(trial % 4)],
                      kCutSpan,
                      {policy});
    const std::vector<Pose> motion = RandomMotion(static_cast<std::uint32_t>(trial), 60, true);
    static_cast<void>(Replay(model, motion));
    const Pose rest = motion.back();
    // What a motion left overloaded (the blades were opening while they sliced) settles in the
    // first excursions.
    for (const int side : {-1, 1, -1, 1}) {
      static_cast<void>(model.Step(rest.theta_rad + side * count_rad, rest.pivot_mm, 1e-3));
    }
    const double crack_mm = model.Step(rest.theta_rad, rest.pivot_mm, 1e-3).x_c_mm;
    for (int i = 0; i < 2000; ++i) {
      const double noise = count_rad * (static_cast<int>(random() % 3) - 1);
      EXPECT_NEAR(
          model.Step(rest.theta_rad + noise, rest.pivot_mm, 1e-3).x_c_mm - crack_mm, 0, 1e-12)
          << "trial " << trial;
    }
  }
}

TEST(TorqueModelExtremes, WhatIsNoMotionGivesTheLastSafeOutputAndAFlag) {
  std::mt19937 random(9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int trial = 0; trial < 100; ++trial) {
    const BladeCurve blade = trial % 2 == 0 ? SmallMetzenbaum() : CurvedBlade();
    TorqueModel model(blade, PaperMaterials()[random() % 4], {30, 60}), undisturbed = model;
    const std::vector<Pose> motion = RandomMotion(
        static_cast<std::uint32_t>(random()), 30 + static_cast<int>(random() % 200), true);
    const TorqueSample safe = Replay(model, motion).back();
    for (int i = 0; i < 10; ++i) {
      double input[] = {Uniform(random, 0, 0.5), Uniform(random, 0, 9), 1e-3};
      const std::size_t which = random() % 3;
      input[which] = random() % 2 == 0 ? nan : (random() % 2 == 0 ? kInf : -kInf);
      if (random() % 4 == 0) input[2] = -1;
      const bool late = random() % 4 == 0;
      const TorqueSample sample =
          late ? model.Step(0.1, 0, 3600) : model.Step(input[0], input[1], input[2]);
      EXPECT_EQ(sample.torque_nmm, safe.torque_nmm);
      EXPECT_EQ(sample.force_x_n, safe.force_x_n);
      EXPECT_EQ(sample.x_c_mm, safe.x_c_mm);
      EXPECT_NE(sample.flags & (late ? kTorqueStepTooLong : kTorqueBadInput), 0u);
    }
    // The motion goes on from where it was, as if nothing had been.
    static_cast<void>(Replay(undisturbed, motion));
    EXPECT_EQ(model.Step(0.19, 0, 1e-3).torque_nmm, undisturbed.Step(0.19, 0, 1e-3).torque_nmm);
  }
}

TEST(TorqueModelExtremes, RandomNonsenseNeverMakesTheTorqueNegativeOrInfinite) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const BladeCurve blade(
        TaperedRectangle{
            Uniform(random, -20, 5), Uniform(random, -0.5, 0.5), Uniform(random, -1, 2)},
        {Uniform(random, -10, 20), Uniform(random, 30, 200), -0.2, 1.5});
    const double edge_mm = Uniform(random, -20, 100);
    TorqueModel model(blade,
                      {"any",
                       LogUniform(random, 1e-6, 1e6),
                       LogUniform(random, 1e-6, 1e3),
                       ForceDeflection(LogUniform(random, 1e-6, 1e9))},
                      {edge_mm, edge_mm + LogUniform(random, 1e-6, 1e3)},
                      {trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion});
    for (int i = 0; i < 60; ++i) {
      const double pivot_mm = random() % 4 == 0 ? Uniform(random, -200, 200) : 0;
      ExpectFinite(model.Step(Uniform(random, -1, 2), pivot_mm, 1e-3),
                   "trial " + std::to_string(trial));
    }
  }
}

}  // namespace
}  // namespace bladecurve
