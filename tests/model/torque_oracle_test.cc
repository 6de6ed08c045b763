// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The model beside a slow brute-force one, over random motions with reopening and slicing.
#include <gtest/gtest.h>

#include <cmath>

#include "model/torque.h"
#include "tests/model/cutting_oracle.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

// The oracle finds turning points only to its substep: the crack it leaves there is short by up to
// half a substep squared, and the torque follows with the plate's stiffness.
constexpr double kTolerance = 1e-6;

struct Effort {
  PlateSpan span{45, 68};
  bool slicing = false;
  int motions = 1, samples = 200, substeps = 8;
};

struct Deviation {
  double torque = 0, crack_mm = 0, force = 0;  // torque and force relative to the largest
  int phases = 0, cutting = 0;                 // samples with another phase; samples that cut
};

Deviation Compare(const BladeCurve& blade,
                  const Material& material,
                  DeltaPolicy policy,
                  const std::vector<Pose>& motion,
                  const Effort& effort) {
  TorqueModel model(blade, material, effort.span, {policy});
  CuttingOracle oracle(blade, material, effort.span, policy, effort.substeps);
  Deviation deviation;
  double largest = 0, largest_force = 0;
  for (const Pose& pose : motion) {
    const TorqueSample sample = model.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
    const CuttingOracle::Sample truth = oracle.Step(pose.theta_rad, pose.pivot_mm);
    largest = std::max(largest, std::abs(sample.torque_nmm));
    largest_force = std::max(largest_force, std::abs(sample.force_x_n));
    deviation.torque = std::max(
        deviation.torque, std::abs(sample.torque_nmm - static_cast<double>(truth.torque_nmm)));
    deviation.force = std::max(deviation.force,
                               std::abs(sample.force_x_n - static_cast<double>(truth.force_x_n)));
    deviation.crack_mm =
        std::max(deviation.crack_mm, std::abs(sample.x_c_mm - static_cast<double>(truth.x_c_mm)));
    deviation.phases += sample.phase != truth.phase;
    deviation.cutting += sample.phase == Phase::kCutting;
  }
  deviation.torque /= std::max(largest, 1e-9);
  deviation.force /= std::max(largest_force, 1e-9);
  return deviation;
}

void ExpectAgreement(const BladeCurve& blade, const Effort& effort) {
  int cutting = 0;
  for (const Material& material : PaperMaterials()) {
    for (const DeltaPolicy policy : {DeltaPolicy::kConstant, DeltaPolicy::kCriterion}) {
      for (int seed = 0; seed < effort.motions; ++seed) {
        const std::vector<Pose> motion =
            RandomMotion(static_cast<std::uint32_t>(seed), effort.samples, effort.slicing);
        const Deviation deviation = Compare(blade, material, policy, motion, effort);
        const std::string scene = material.name + ", policy " +
                                  std::to_string(static_cast<int>(policy)) + ", seed " +
                                  std::to_string(seed);
        EXPECT_LT(deviation.torque, kTolerance) << scene;
        EXPECT_LT(deviation.force, kTolerance) << scene;
        EXPECT_LT(deviation.crack_mm, kTolerance) << scene;
        EXPECT_EQ(deviation.phases, 0) << scene;
        cutting += deviation.cutting;
      }
    }
  }
  EXPECT_GT(cutting, 100) << "the motions hardly cut: the comparison says little";
}

TEST(TorqueModel, EqualsTheBruteForceModelOnPaperScissorsThatOpenAgain) {
  ExpectAgreement(SmallMetzenbaum(), {.motions = 3, .substeps = 4});
  ExpectAgreement(LargeMetzenbaum(), {.motions = 1, .substeps = 4});
}

TEST(TorqueModel, EqualsTheBruteForceModelOnPaperScissorsThatSlice) {
  ExpectAgreement(SmallMetzenbaum(), {.slicing = true, .motions = 2, .substeps = 32});
}

TEST(TorqueModel, EqualsTheBruteForceModelOnACurvedBladeThatOpensAgain) {
  ExpectAgreement(CurvedBlade(), {.span = {25, 60}, .samples = 100, .substeps = 1});
}

TEST(TorqueModel, EqualsTheBruteForceModelOnACurvedBladeThatSlices) {
  ExpectAgreement(CurvedBlade(), {.span = {25, 60}, .slicing = true, .samples = 80, .substeps = 1});
}

}  // namespace
}  // namespace bladecurve
