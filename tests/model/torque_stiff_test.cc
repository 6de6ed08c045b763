// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Twelve decades of every parameter, stiff plates and steps of any length, over seeded random
// input.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"
#include "tests/model/extreme_checks.h"

namespace bladecurve {
namespace {

constexpr double kSame = 1e-9;  // nothing is integrated in time: only rounding may differ

struct StiffScene {
  BladeCurve blade;
  Material material;
  PlateSpan span;
  TorqueOptions options;
  std::string name;
};

// J_c, h and k over twelve decades each; h no thicker than scissors open, but in every third scene.
StiffScene RandomStiffScene(std::mt19937& random, int trial) {
  const bool curved = trial % 4 == 0;
  const double most = trial % 3 == 0 ? 1e6 : 10;
  const Material material{"any",
                          2.8 * LogUniform(random, 1e-6, 1e6),
                          0.3 * LogUniform(random, 1e-6, most),
                          ForceDeflection(5 * LogUniform(random, 1e-6, 1e6))};
  return {curved ? CurvedBlade() : SmallMetzenbaum(),
          material,
          curved ? PlateSpan{25, 60} : kCutSpan,
          {trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion},
          "trial " + std::to_string(trial)};
}

// By the criterion the crack may rest again, while the blades close, in a plate so thick that they
// never come to lie beside it: tau_c then grows faster than the plate's resistance.
bool MayRest(const StiffScene& scene) {
  constexpr double kThick_mm = 5;
  return scene.options.delta_policy == DeltaPolicy::kCriterion &&
         scene.material.thickness_mm > kThick_mm;
}

// Closes in so many steps; the phases must come in order.
TorqueSample CloseInOrder(const StiffScene& scene, double from_deg, double to_deg, int steps) {
  TorqueModel model(scene.blade, scene.material, scene.span, scene.options);
  TorqueSample sample;
  Phase last = Phase::kNone;
  for (const Pose& pose : StraightMotion(from_deg, to_deg, steps)) {
    sample = model.Step(pose.theta_rad, 0, 1e-3);
    ExpectFinite(sample, scene.name);
    EXPECT_NE(sample.phase, Phase::kRelaxation) << scene.name;
    EXPECT_TRUE(sample.phase >= last || MayRest(scene)) << scene.name << ": the phases went back";
    last = sample.phase;
  }
  return sample;
}

void ExpectSame(const TorqueSample& a, const TorqueSample& b, const std::string& scene) {
  EXPECT_EQ(a.phase, b.phase) << scene;
  EXPECT_NEAR(a.x_c_mm, b.x_c_mm, kSame * 100) << scene;
  EXPECT_NEAR(a.torque_nmm, b.torque_nmm, kSame * (1 + b.torque_nmm)) << scene;
  EXPECT_NEAR(a.delta_mm, b.delta_mm, kSame * (1 + std::abs(b.delta_mm))) << scene;
}

TEST(TorqueModelExtremes, TwelveDecadesKeepThePhasesInOrderAndTheAnswerWhenStepsAreHalved) {
  std::mt19937 random(3);
  int cut = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const StiffScene scene = RandomStiffScene(random, trial);
    const double to_deg = Uniform(random, 0, 10);
    const TorqueSample whole = CloseInOrder(scene, 30, to_deg, 50);
    ExpectSame(CloseInOrder(scene, 30, to_deg, 100), whole, scene.name);
    cut += whole.phase >= Phase::kCutting;
  }
  EXPECT_GT(cut, 500);
}

TEST(TorqueModelExtremes, AnyRateFromTenHertzToEightKilohertzGivesTheSameAnswer) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const StiffScene scene = RandomStiffScene(random, 12 * trial + trial % 3);  // both blades
    const double to_deg = Uniform(random, 1, 20);
    const TorqueSample reference = CloseInOrder(scene, 28, to_deg, 1);
    // 9.3 s at 3 deg/s: 10 Hz and its doubles up to 10 kHz, in few scenes beyond 1 kHz.
    for (int steps = 93; steps <= (trial < 4 ? 95232 : 6000); steps *= 2)
      ExpectSame(CloseInOrder(scene, 28, to_deg, steps), reference, scene.name);
  }
}

// A plate of some thickness, as stiff as they come: in the limit it is cut as soon as it is
// touched.
Material StiffMaterial(std::mt19937& random) {
  return {"stiff",
          LogUniform(random, 1, 10),
          LogUniform(random, 0.03, 1),
          ForceDeflection(LogUniform(random, 1e3, 1e9))};
}

TEST(TorqueModelExtremes, AStiffPlateMissesNoPhaseAndNeverShowsMoreThanTheCuttingTorque) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    const double rate_hz = std::array{10.0, 250.0, 1000.0}[static_cast<std::size_t>(trial % 3)];
    const TorqueOptions options{trial % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion};
    const bool curved = trial % 4 < 2;
    const Material material = StiffMaterial(random);
    TorqueModel model(curved ? CurvedBlade() : SmallMetzenbaum(),
                      material,
                      curved ? PlateSpan{25, 50} : kCutSpan,
                      options);
    const std::string scene = "trial " + std::to_string(trial) +
                              ", k = " + std::to_string(material.force_deflection.Eval(1).force_n);
    std::vector<TorqueEventKind> events;
    for (const Pose& pose : StraightMotion(34, 0, static_cast<int>(11 * rate_hz))) {
      const TorqueSample sample = model.Step(pose.theta_rad, 0, 1 / rate_hz);
      for (const TorqueEvent& event : model.events()) events.push_back(event.kind);
      if (sample.phase != Phase::kDeformation && sample.phase != Phase::kCutting) continue;
      const CurveSample edge = model.blade().Eval(sample.x_c_mm, pose.theta_rad);
      const double cutting_nmm = material.toughness_n_per_mm * material.thickness_mm *
                                 edge.phi_theta_mm_per_rad / edge.phi_x;
      EXPECT_LE(sample.torque_nmm, cutting_nmm * (1 + kSame)) << scene;
    }
    EXPECT_EQ(
        events,
        (std::vector{
            TorqueEventKind::kContact, TorqueEventKind::kCutStart, TorqueEventKind::kThrough}))
        << scene;
  }
}

}  // namespace
}  // namespace bladecurve
