// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The model takes energy out of the hand and never gives more back.
#include <gtest/gtest.h>

#include <cmath>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

// Work of the hand over one step, -integral of tau dtheta, by the trapezoidal rule.
double StepWork(const TorqueSample& from, const TorqueSample& to, double turn_rad) {
  return -0.5 * (from.torque_nmm + to.torque_nmm) * turn_rad;
}

struct Loop {
  double work_nmm = 0;
  double error_nmm = 0;  // of the rule: where the torque has a kink or a jump within a step
};

// Angles that wander between 5 and 25 degrees and come back to where they began; the pivot at rest.
Loop RandomLoop(TorqueModel& model, std::mt19937& random, int corners) {
  constexpr int kStepsPerSide = 16;
  std::vector<double> angles_rad = {Uniform(random, 5, 25) * kRad};
  for (int i = 1; i < corners; ++i) angles_rad.push_back(Uniform(random, 5, 25) * kRad);
  angles_rad.push_back(angles_rad.front());
  Loop loop;
  TorqueSample last = model.Step(angles_rad.front(), 0, 1e-3);
  for (std::size_t corner = 1; corner < angles_rad.size(); ++corner) {
    const double from_rad = angles_rad[corner - 1],
                 turn_rad = (angles_rad[corner] - from_rad) / kStepsPerSide;
    for (int i = 1; i <= kStepsPerSide; ++i) {
      const TorqueSample sample = model.Step(from_rad + turn_rad * i, 0, 1e-3);
      loop.work_nmm += StepWork(last, sample, turn_rad);
      const double change_nmm = std::abs(sample.torque_nmm - last.torque_nmm);
      if (sample.phase != last.phase || !model.events().empty())
        loop.error_nmm += change_nmm * std::abs(turn_rad);
      loop.error_nmm += 0.02 * change_nmm * std::abs(turn_rad);
      last = sample;
    }
  }
  return loop;
}

TEST(TorqueModelPassivity, NoClosedLoopOfTheBladesGivesEnergy) {
  constexpr int kLoops = 100000;
  std::mt19937 random(9);
  const std::vector<Material> materials = PaperMaterials();
  double least_nmm = 0;
  for (int i = 0; i < kLoops; ++i) {
    const DeltaPolicy policy = i % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion;
    TorqueModel model(
        SmallMetzenbaum(), materials[random() % materials.size()], {45, 200}, {policy});
    static_cast<void>(model.Step(30 * kRad, 0, 1e-3));
    static_cast<void>(
        model.Step(Uniform(random, 5, 25) * kRad, 0, 1e-3));  // some crack to begin with
    const Loop loop = RandomLoop(model, random, 2 + static_cast<int>(random() % 2));
    least_nmm = std::min(least_nmm, loop.work_nmm + loop.error_nmm);
  }
  EXPECT_GE(least_nmm, 0);
}

TEST(TorqueModelPassivity, ALoopThatCutsNothingGivesBackWhatItTook) {
  // Elastic only: the torque is a function of the angle.
  TorqueModel model(SmallMetzenbaum(), {"tough", 1e9, 0.1, ForceDeflection(5)}, {45, 68});
  double work_nmm = 0, taken_nmm = 0;
  TorqueSample last = model.Step(25 * kRad, 0, 1e-3);
  std::vector<Pose> motion = StraightMotion(25, 5, 2000);
  for (const Pose& pose : StraightMotion(5, 25, 2000)) motion.push_back(pose);
  double theta_rad = 25 * kRad;
  for (const Pose& pose : motion) {
    const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
    work_nmm += StepWork(last, sample, pose.theta_rad - theta_rad);
    taken_nmm = std::max(taken_nmm, work_nmm);
    theta_rad = pose.theta_rad;
    last = sample;
  }
  EXPECT_GT(taken_nmm, 1);
  EXPECT_NEAR(work_nmm, 0, 1e-9 * taken_nmm);
}

}  // namespace
}  // namespace bladecurve
