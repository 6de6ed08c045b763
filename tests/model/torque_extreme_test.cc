// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Extreme and stiff cases, each over seeded random input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

constexpr PlateSpan kSpan{45, 68};
constexpr double kInf = std::numeric_limits<double>::infinity();

void ExpectFinite(const TorqueSample& sample, const std::string& scene) {
  EXPECT_TRUE(std::isfinite(sample.torque_nmm) && std::isfinite(sample.force_x_n) &&
              std::isfinite(sample.x_c_mm) && std::isfinite(sample.delta_mm) &&
              std::isfinite(sample.normal_force_n))
      << scene;
  EXPECT_GE(sample.torque_nmm, 0) << scene;
}

double LogUniform(std::mt19937& random, double low, double high) {
  return std::exp(Uniform(random, std::log(low), std::log(high)));
}

TEST(TorqueModelExtremes, ABladeThatCannotCutKeepsItsLastValidTorqueAndIsFlagged) {
  std::mt19937 random(1);
  int flagged = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double b = Uniform(random, -0.3, 0.05);  // the slope reaches zero while the blades close
    const BladeCurve blade(TaperedRectangle{Uniform(random, -6, 1), b, 0.5}, {0, 1e6, 0, 1.2});
    TorqueModel model(blade, PaperMaterials()[0], kSpan);
    for (const Pose& pose : StraightMotion(60, 0, 600)) {
      const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
      ExpectFinite(sample, "b = " + std::to_string(b));
      flagged += (sample.flags & kTorqueCannotCut) != 0;
    }
  }
  EXPECT_GT(flagged, 100);
}

TEST(TorqueModelExtremes, AnyAngleGivesAFiniteTorqueAndAFlagOutsideTheDomain) {
  std::mt19937 random(2);
  const double angles[] = {
      0, -1e-9, -0.3, -1, -3.2, 1.2, 3.14159265, 3.15, 7, 1e3, -1e6, 1e12, -1e300};
  for (int trial = 0; trial < 300; ++trial) {
    const BladeCurve blade = trial % 2 == 0 ? SmallMetzenbaum() : CurvedBlade();
    TorqueModel model(blade, PaperMaterials()[static_cast<std::size_t>(trial % 4)], kSpan);
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
  // s = b + tan(theta/2)/2 has its zero at theta = -31 deg.
  const BladeCurve blade(TaperedRectangle{-11, 0.14, 0.5}, {0, 80, -1, 1.2});
  TorqueModel model(blade, PaperMaterials()[0], {45, 1000});
  TorqueSample sample;
  for (const Pose& pose : StraightMotion(30, -31, 6000)) {
    sample = model.Step(pose.theta_rad, 0, 1e-3);
    ExpectFinite(sample, "beyond the tip");
    EXPECT_LT(sample.torque_nmm, 200);
  }
  EXPECT_EQ(sample.phase, Phase::kNone);
  EXPECT_EQ(sample.torque_nmm, 0);
  EXPECT_NE(sample.flags & kTorqueBeyondBlade, 0u);
}

TEST(TorqueModelExtremes, TorqueFadesSmoothlyAtBothEndsOfTheBlade) {
  for (const double to_mm :
       {-120.0, 60.0}) {  // the pivot withdraws beyond the blade; or comes up to the crack
    TorqueModel model(BladeCurve(TaperedRectangle{-11, 0.14, 0.5}, {0, 80, 0, 1.2}),
                      {"tough", 1e9, 0.1, ForceDeflection(5)},
                      {50, 68});
    double before = model.Step(5 * kRad, 0, 1e-3).torque_nmm;
    double last = before;
    const int steps = 200000;
    for (int i = 1; i <= steps; ++i) {
      const TorqueSample sample = model.Step(5 * kRad, to_mm * i / steps, 1e-3);
      ExpectFinite(sample, "pivot");
      EXPECT_LT(std::abs(sample.torque_nmm - last), 0.01 * before)
          << "a jump at pivot " << to_mm * i / steps;
      last = sample.torque_nmm;
    }
    EXPECT_EQ(last, 0);
  }
}

// Largest change of the final state and of the phases' order when every step is halved.
TEST(TorqueModelExtremes, TwelveDecadesOfEachParameterKeepThePhasesInOrder) {
  std::mt19937 random(3);
  int cut = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Material material{"any",
                            2.8 * LogUniform(random, 1e-6, 1e6),
                            0.3 * LogUniform(random, 1e-6, trial % 3 == 0 ? 1e6 : 10),
                            ForceDeflection(5 * LogUniform(random, 1e-6, 1e6))};
    const DeltaPolicy policy = trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion;
    TorqueModel model(SmallMetzenbaum(), material, kSpan, {policy});
    Phase last = Phase::kNone;
    const std::string scene = "trial " + std::to_string(trial);
    for (const Pose& pose : StraightMotion(30, 0, 100)) {
      const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
      ExpectFinite(sample, scene);
      EXPECT_NE(sample.phase, Phase::kRelaxation) << scene;
      EXPECT_GE(sample.phase, last) << scene << ": the phases went back";
      last = sample.phase;
    }
    cut += last == Phase::kThrough;
  }
  EXPECT_GT(cut, 300);
}

TEST(TorqueModelExtremes, AnyStepGivesTheSameAnswerFromTenHertzToEightKilohertz) {
  constexpr double kSame = 1e-9;  // nothing is integrated in time: only rounding may differ
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const Material material{"any",
                            2.8 * LogUniform(random, 1e-3, 1e3),
                            0.1 * LogUniform(random, 0.1, 10),
                            ForceDeflection(5 * LogUniform(random, 1e-3, 1e6))};
    const double to_deg = Uniform(random, 1, 20);
    const BladeCurve blade = trial % 2 == 0 ? SmallMetzenbaum() : CurvedBlade();
    const PlateSpan span = trial % 2 == 0 ? kSpan : PlateSpan{25, 60};
    TorqueSample reference;
    for (const int steps :
         {1, 93, 930, 9300, 74400}) {  // 9.3 s at 3 deg/s: one step, 10 Hz, 100 Hz, 1 kHz, 8 kHz
      if (steps > 9300 && trial > 2) continue;
      TorqueModel model(blade, material, span);
      const TorqueSample sample = Replay(model, StraightMotion(28, to_deg, steps)).back();
      if (steps == 1) reference = sample;
      const std::string scene =
          "trial " + std::to_string(trial) + ", steps " + std::to_string(steps);
      EXPECT_EQ(sample.phase, reference.phase) << scene;
      EXPECT_NEAR(sample.x_c_mm, reference.x_c_mm, kSame * 100) << scene;
      EXPECT_NEAR(sample.torque_nmm, reference.torque_nmm, kSame * (1 + reference.torque_nmm))
          << scene;
    }
  }
}

TEST(TorqueModelExtremes, AStiffPlateNeverShowsMoreThanTheCuttingTorque) {
  for (const double k : {1e3, 1e6, 1e9}) {
    for (const double rate_hz : {10.0, 250.0, 1000.0}) {
      TorqueModel model(SmallMetzenbaum(), {"stiff", 4.9, 0.1, ForceDeflection(k)}, kSpan);
      bool cut = false;
      for (const Pose& pose : StraightMotion(30, 0, static_cast<int>(10 * rate_hz))) {
        const TorqueSample sample = model.Step(pose.theta_rad, 0, 1 / rate_hz);
        EXPECT_LT(sample.torque_nmm, 53)
            << "k = " << k << " at " << rate_hz << " Hz";  // tau_c at the plate's end
        cut = cut || sample.phase == Phase::kCutting;
      }
      EXPECT_TRUE(cut) << "the cut was missed: k = " << k << " at " << rate_hz << " Hz";
    }
  }
}

// An edge that dips between two rises: several x have the same phi.
BladeCurve WavyBlade() {
  return {RigidSpline{
              3, {5, 5, 5, 5, 25, 40, 55, 80, 80, 80, 80}, {-6, -5.6, -3.6, -1.6, -4.2, -1.2, 0}},
          {8, 79, 0, 1.2}};
}

TEST(TorqueModelExtremes, TheCrackFollowsOneContactAndJumpsOnlyWhereThatEnds) {
  std::mt19937 random(5);
  int jumps = 0;
  for (int trial = 0; trial < 60; ++trial) {
    TorqueModel model(WavyBlade(), PaperMaterials()[static_cast<std::size_t>(trial % 4)], {25, 75});
    const int steps = 100 + static_cast<int>(random() % 3000);
    double crack_mm = 25;
    for (const Pose& pose : StraightMotion(35, 0, steps)) {
      const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
      ExpectFinite(sample, "wavy blade");
      EXPECT_GE(sample.x_c_mm, crack_mm) << "the crack healed";
      crack_mm = sample.x_c_mm;
      if (sample.phase == Phase::kCutting && (sample.flags & kTorqueCannotCut) == 0) {
        EXPECT_GT(model.blade().Eval(sample.x_c_mm, pose.theta_rad).phi_x, 0);
      }
      for (const TorqueEvent& event : model.events()) jumps += event.kind == TorqueEventKind::kSnap;
    }
  }
  EXPECT_EQ(jumps, 60) << "the edge has one dip";
}

TEST(TorqueModelExtremes, EncoderNoiseAloneCutsNothing) {
  std::mt19937 random(6);
  const double count_rad = 0.01 * kRad;
  for (int trial = 0; trial < 100; ++trial) {
    const DeltaPolicy policy = trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion;
    TorqueModel model(
        SmallMetzenbaum(), PaperMaterials()[static_cast<std::size_t>(trial % 4)], kSpan, {policy});
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
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], kSpan);
  const std::vector<Pose> motion = StraightMotion(30, 12, 500);
  const TorqueSample safe = Replay(model, motion).back();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inputs[][3] = {{nan, 0, 1e-3},
                              {0.1, nan, 1e-3},
                              {0.1, 0, nan},
                              {kInf, 0, 1e-3},
                              {0.1, -kInf, 1e-3},
                              {0.1, 0, -1}};
  for (const auto& input : inputs) {
    const TorqueSample sample = model.Step(input[0], input[1], input[2]);
    EXPECT_EQ(sample.torque_nmm, safe.torque_nmm);
    EXPECT_EQ(sample.x_c_mm, safe.x_c_mm);
    EXPECT_NE(sample.flags & kTorqueBadInput, 0u);
  }
  const TorqueSample late = model.Step(0.1, 0, 3600);
  EXPECT_EQ(late.torque_nmm, safe.torque_nmm);
  EXPECT_NE(late.flags & kTorqueStepTooLong, 0u);
  // The motion goes on from where it was, as if nothing had been.
  TorqueModel undisturbed(SmallMetzenbaum(), PaperMaterials()[0], kSpan);
  static_cast<void>(Replay(undisturbed, motion));
  EXPECT_EQ(model.Step(0.19, 0, 1e-3).torque_nmm, undisturbed.Step(0.19, 0, 1e-3).torque_nmm);
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
