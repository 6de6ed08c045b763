// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/fluctuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

TorqueOptions With(const Fluctuation& fluctuation) {
  TorqueOptions options;
  options.fluctuation = fluctuation;
  return options;
}

struct FluctuatingScene {
  BladeCurve blade;
  PlateSpan span;
  Material material;
  Fluctuation fluctuation;
};

FluctuatingScene RandomFluctuatingScene(std::mt19937& random) {
  const bool curved = random() % 2 == 0;
  return {curved ? CurvedBlade() : SmallMetzenbaum(),
          curved ? PlateSpan{25, 60} : PlateSpan{45, 68},
          PaperMaterials()[random() % 4],
          {std::exp(Uniform(random, std::log(0.02), std::log(2))),
           Uniform(random, 0, 0.95),
           static_cast<std::uint32_t>(random())}};
}

std::string Name(const FluctuatingScene& s) {
  return s.material.name + ", rupture " + std::to_string(s.fluctuation.rupture_mm) +
         " mm, spread " + std::to_string(s.fluctuation.spread);
}

// What the header calls kappa, from its formula.
double Kappa(const FluctuatingScene& s, const TorqueSample& at, double theta_rad) {
  const CurveSample e = s.blade.Eval(at.x_c_mm, theta_rad);
  const double cos_alpha = std::cos(theta_rad / 2 - std::atan(e.phi_x));
  const double k = s.material.force_deflection.initial_stiffness_n_per_mm();
  return at.x_c_mm * k * e.phi_x * e.phi_x * cos_alpha / e.phi_theta_mm_per_rad;
}

// A finely sampled stretch of cutting from the first angle to the second.
struct Stretch {
  double excess_nmm = 0;    // work beyond that of the mean torque
  double bound_nmm = 0;     // what the header states for it
  double sampling_nmm = 0;  // what the trapezoidal rule may be off by, at the ruptures' jumps
  double largest_share = 0;
  bool all_cutting = true;
};

Stretch CutStretch(const FluctuatingScene& s, double from_deg, double to_deg) {
  TorqueModel mean(s.blade, s.material, s.span),
      rough(s.blade, s.material, s.span, With(s.fluctuation));
  static_cast<void>(Replay(mean, StraightMotion(35, from_deg, 100)));
  static_cast<void>(Replay(rough, StraightMotion(35, from_deg, 100)));
  Stretch stretch;
  double kappa_most = 0, kappa_variation = 0, kappa_last = NAN, last = 0;
  constexpr int kSteps = 8000;
  const double turn_rad = (from_deg - to_deg) * kDegree / kSteps;
  for (const Pose& pose : StraightMotion(from_deg, to_deg, kSteps)) {
    const TorqueSample a = mean.Step(pose.theta_rad, 0, 1e-3);
    const TorqueSample b = rough.Step(pose.theta_rad, 0, 1e-3);
    stretch.all_cutting = stretch.all_cutting && a.phase == Phase::kCutting;
    EXPECT_EQ(a.x_c_mm, b.x_c_mm) << "the mean crack is another";
    EXPECT_GE(b.torque_nmm, 0);
    const double kappa = Kappa(s, a, pose.theta_rad), excess = b.torque_nmm - a.torque_nmm;
    kappa_most = std::max(kappa_most, kappa);
    if (!std::isnan(kappa_last)) {
      kappa_variation += std::abs(kappa - kappa_last);
      stretch.excess_nmm += 0.5 * (excess + last) * turn_rad;
      stretch.sampling_nmm += std::abs(excess - last) * turn_rad;
    }
    stretch.largest_share = std::max(stretch.largest_share, std::abs(excess) / a.torque_nmm);
    kappa_last = kappa;
    last = excess;
  }
  const double longest_mm = s.fluctuation.rupture_mm * (1 + s.fluctuation.spread);
  stretch.bound_nmm = longest_mm * longest_mm / 8 * (kappa_most + kappa_variation);
  return stretch;
}

TEST(Fluctuation, MeanTorqueOfAnyWindowIsTauCWithinItsBound) {
  std::mt19937 random(1);
  int tested = 0, rough = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const FluctuatingScene s = RandomFluctuatingScene(random);
    const double from_deg = Uniform(random, 10, 18), to_deg = from_deg - Uniform(random, 0.2, 4);
    const Stretch stretch = CutStretch(s, from_deg, to_deg);
    if (!stretch.all_cutting) continue;
    ++tested;
    rough += stretch.largest_share > 0.05;
    EXPECT_LE(std::abs(stretch.excess_nmm), stretch.bound_nmm + stretch.sampling_nmm) << Name(s);
  }
  EXPECT_GT(tested, 30);
  EXPECT_GT(rough, 15) << "hardly a fluctuation to average";
}

TEST(Fluctuation, RupturesFollowOneAnotherWithTheLengthsAskedFor) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Fluctuation f = RandomFluctuatingScene(random).fluctuation;
    double sum_mm = 0, least_mm = HUGE_VAL, most_mm = 0;
    constexpr int kRuptures = 3000;
    Rupture rupture = RuptureAt(f, Uniform(random, -50, 50));
    for (int i = 0; i < kRuptures; ++i) {
      const Rupture inside =
          RuptureAt(f, rupture.begin_mm + Uniform(random, 0.01, 0.99) * rupture.length_mm);
      EXPECT_EQ(inside.begin_mm, rupture.begin_mm);
      sum_mm += rupture.length_mm;
      least_mm = std::min(least_mm, rupture.length_mm);
      most_mm = std::max(most_mm, rupture.length_mm);
      const double end_mm = rupture.begin_mm + rupture.length_mm;
      rupture = RuptureAt(f, end_mm + 1e-9 * f.rupture_mm);
      EXPECT_NEAR(rupture.begin_mm, end_mm, 1e-12 * (1 + std::abs(end_mm)));
    }
    constexpr double kRounding = 1e-9;
    EXPECT_NEAR(sum_mm / kRuptures, f.rupture_mm, f.rupture_mm / kRuptures * (1 + kRounding));
    EXPECT_GE(least_mm, f.rupture_mm * (1 - f.spread) - kRounding);
    EXPECT_LE(most_mm, f.rupture_mm * (1 + f.spread) + kRounding);
    EXPECT_GE(most_mm - least_mm, f.rupture_mm * f.spread - kRounding);
  }
}

std::vector<double> Torques(const FluctuatingScene& s, const TorqueOptions& options) {
  TorqueModel model(s.blade, s.material, s.span, options);
  std::vector<double> torques;
  for (const TorqueSample& sample : Replay(model, RandomMotion(7, 800, true)))
    torques.push_back(sample.torque_nmm);
  return torques;
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(Fluctuation, ReplaysToTheSameBitsAndAnotherSeedToOthers) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 10; ++trial) {
    FluctuatingScene s = RandomFluctuatingScene(random);
    s.fluctuation.spread = 0.5;
    const std::vector<double> first = Torques(s, With(s.fluctuation));
    EXPECT_TRUE(SameBits(first, Torques(s, With(s.fluctuation)))) << Name(s);
    ++s.fluctuation.seed;
    EXPECT_FALSE(SameBits(first, Torques(s, With(s.fluctuation)))) << Name(s);
  }
}

TEST(Fluctuation, OfLengthZeroHasNoInfluenceWhateverItsOtherNumbers) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const FluctuatingScene s = RandomFluctuatingScene(random);
    EXPECT_TRUE(SameBits(Torques(s, {}), Torques(s, With({0, 0.9, 77})))) << Name(s);
  }
}

TEST(Fluctuation, LeavesCrackPhaseAndLedgerAsTheyAre) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const FluctuatingScene s = RandomFluctuatingScene(random);
    TorqueModel mean(s.blade, s.material, s.span),
        rough(s.blade, s.material, s.span, With(s.fluctuation));
    for (const Pose& pose : RandomMotion(static_cast<std::uint32_t>(trial), 300, true)) {
      const TorqueSample a = mean.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
      const TorqueSample b = rough.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
      EXPECT_EQ(a.x_c_mm, b.x_c_mm);
      EXPECT_EQ(a.phase, b.phase);
      EXPECT_TRUE(a.phase == Phase::kCutting || a.torque_nmm == b.torque_nmm);
    }
    EXPECT_EQ(mean.ledger().cut_work_nmm, rough.ledger().cut_work_nmm);
  }
}

TEST(Fluctuation, NamesWhatCannotBe) {
  for (const Fluctuation& f : {Fluctuation{-1},
                               Fluctuation{NAN},
                               Fluctuation{1e9},
                               Fluctuation{1, 1},
                               Fluctuation{1, -0.1},
                               Fluctuation{1, NAN}}) {
    EXPECT_THROW(TorqueModel(SmallMetzenbaum(), PaperMaterials()[0], {45, 68}, With(f)),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace bladecurve
