// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// What torque.h guarantees of energy, and what it does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

// Work of the hand over one step, -integral of tau dtheta, by the trapezoidal rule.
double StepWork(const TorqueSample& from, const TorqueSample& to, double turn_rad) {
  return -0.5 * (from.torque_nmm + to.torque_nmm) * turn_rad;
}

// The same against the force on the pivot, -integral of f_x dX_p.
double PushWork(const TorqueSample& from, const TorqueSample& to, double move_mm) {
  return -0.5 * (from.force_x_n + to.force_x_n) * move_mm;
}

// Work along a motion, and what the trapezoidal rule may be off by: a kink or a jump within a step
// by the change times the step; else by its curvature, a 12th of the change of slope, and the slope
// of the torque changes by less than a fourth from one step to the next.
class Meter {
 public:
  explicit Meter(TorqueModel model) : model_(std::move(model)) {}

  void MoveTo(const Pose& pose, int steps) {
    if (!started_) {
      last_ = model_.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
      pose_ = pose;
      started_ = true;
    }
    const Pose from = pose_;
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      Take({std::lerp(from.theta_rad, pose.theta_rad, share),
            std::lerp(from.pivot_mm, pose.pivot_mm, share)});
    }
  }

  // Begins a loop here.
  void Restart() { work_nmm_ = error_nmm_ = least_nmm_ = 0; }

  [[nodiscard]] double work_nmm() const { return work_nmm_; }
  [[nodiscard]] double error_nmm() const { return error_nmm_; }
  [[nodiscard]] double least_nmm() const { return least_nmm_; }  // of the work so far, plus error
  [[nodiscard]] double crack_mm() const { return last_.x_c_mm + pose_.pivot_mm; }

 private:
  void Take(const Pose& pose) {
    const TorqueSample sample = model_.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
    const double turn_rad = pose.theta_rad - pose_.theta_rad;
    const double move_mm = pose.pivot_mm - pose_.pivot_mm;
    const double change_nmm = std::abs((sample.torque_nmm - last_.torque_nmm) * turn_rad) +
                              std::abs((sample.force_x_n - last_.force_x_n) * move_mm);
    const bool smooth = sample.phase == last_.phase && model_.events().empty();
    work_nmm_ += StepWork(last_, sample, turn_rad) + PushWork(last_, sample, move_mm);
    error_nmm_ += (smooth ? 0.25 / 12 : 1) * change_nmm;
    least_nmm_ = std::min(least_nmm_, work_nmm_ + error_nmm_);
    last_ = sample;
    pose_ = pose;
  }

  TorqueModel model_;
  Pose pose_;
  TorqueSample last_;
  double work_nmm_ = 0, error_nmm_ = 0, least_nmm_ = 0;
  bool started_ = false;
};

constexpr double kOpen_rad = 68 * kDegree;  // touches none of these plates
constexpr int kSteps = 16;                  // of a stretch

struct PassiveScene {
  BladeCurve blade;
  Material material;
  PlateSpan span;
  TorqueOptions options;
};

PassiveScene RandomPassiveScene(std::mt19937& random, bool curved) {
  const BladeCurve paper = random() % 2 == 0 ? SmallMetzenbaum() : LargeMetzenbaum();
  return {curved ? CurvedBlade() : paper,
          PaperMaterials()[random() % 4],
          curved ? PlateSpan{25, 200} : PlateSpan{45, 200},
          {random() % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion}};
}

Meter MeterOf(const PassiveScene& scene) {
  return Meter(TorqueModel(scene.blade, scene.material, scene.span, scene.options));
}

// Angles that wander between 5 and 25 degrees and come back to where they began.
std::vector<double> AngleLoop(std::mt19937& random) {
  std::vector<double> angles_rad = {Uniform(random, 5, 25) * kDegree};
  for (int i = static_cast<int>(random() % 2); i < 2; ++i)
    angles_rad.push_back(Uniform(random, 5, 25) * kDegree);
  angles_rad.push_back(angles_rad.front());
  return angles_rad;
}

TEST(TorqueModelPassivity, BladesAboutAPivotAtRestNeverGiveMoreThanTheyTook) {
  constexpr int kLoops = 100000;
  std::mt19937 random(9);
  double least_nmm = 0, least_loop_nmm = 0;
  int cut = 0;
  for (int i = 0; i < kLoops; ++i) {
    const bool curved = i % 4 == 0;
    Meter meter = MeterOf(RandomPassiveScene(random, curved));
    const double pivot_mm = Uniform(random, -5, 15);
    meter.MoveTo({kOpen_rad, pivot_mm}, 1);
    const std::vector<double> loop_rad = AngleLoop(random);
    meter.MoveTo({loop_rad.front(), pivot_mm}, kSteps);
    const double before_nmm = meter.work_nmm(), error_nmm = meter.error_nmm();
    const double crack_mm = meter.crack_mm();
    for (const double angle_rad : loop_rad) meter.MoveTo({angle_rad, pivot_mm}, kSteps);
    least_nmm = std::min(least_nmm, meter.least_nmm());
    if (curved) continue;
    // The paper's scissors: nor does any closed loop, wherever it begins.
    least_loop_nmm =
        std::min(least_loop_nmm, meter.work_nmm() - before_nmm + meter.error_nmm() - error_nmm);
    cut += meter.crack_mm() > crack_mm;
  }
  EXPECT_GE(least_nmm, 0);
  EXPECT_GE(least_loop_nmm, 0);
  EXPECT_GT(cut, kLoops / 4) << "the loops hardly cut";
}

TEST(TorqueModelPassivity, APivotThatMovesAtOneAngleNeverGivesMoreThanItTook) {
  constexpr int kLoops = 30000;
  std::mt19937 random(10);
  double least_nmm = 0;
  int cut = 0;
  for (int i = 0; i < kLoops; ++i) {
    Meter meter = MeterOf(RandomPassiveScene(random, i % 2 == 0));
    const double theta_rad = Uniform(random, 5, 25) * kDegree;
    meter.MoveTo({theta_rad, -100}, 1);  // withdrawn from the plate
    const double crack_mm = meter.crack_mm();
    for (int corner = 0; corner < 3; ++corner)
      meter.MoveTo({theta_rad, Uniform(random, -10, 15)}, 2 * kSteps);
    meter.MoveTo({theta_rad, -100}, 2 * kSteps);
    least_nmm = std::min(least_nmm, meter.least_nmm());
    cut += meter.crack_mm() > crack_mm;
  }
  EXPECT_GE(least_nmm, 0);
  EXPECT_GT(cut, kLoops / 4) << "the loops hardly cut";
}

// torque.h says so: the torque (2) and the force on the pivot (18) have no common potential. A
// haptic program that moves the pivot has to see to its energy itself.
TEST(TorqueModelPassivity, PivotAndBladesThatMoveInTurnCanGiveEnergy) {
  Meter meter(TorqueModel(SmallMetzenbaum(), {"tough", 1e9, 0.1, ForceDeflection(5)}, {45, 68}));
  meter.MoveTo({20 * kDegree, -20}, 1);   // withdrawn from the plate
  meter.MoveTo({20 * kDegree, 0}, 2000);  // in: f_x takes
  meter.MoveTo({kOpen_rad, 0}, 2000);     // open: the torque gives more
  meter.MoveTo({kOpen_rad, -20}, 10);     // out and closed again, touching nothing
  meter.MoveTo({20 * kDegree, -20}, 10);
  EXPECT_LT(meter.work_nmm() + meter.error_nmm(), -1);
}

TEST(TorqueModelPassivity, ALoopThatCutsNothingGivesBackWhatItTook) {
  // Elastic only: the torque is a function of the angle.
  TorqueModel model(SmallMetzenbaum(), {"tough", 1e9, 0.1, ForceDeflection(5)}, {45, 68});
  double work_nmm = 0, taken_nmm = 0;
  TorqueSample last = model.Step(25 * kDegree, 0, 1e-3);
  std::vector<Pose> motion = StraightMotion(25, 5, 2000);
  for (const Pose& pose : StraightMotion(5, 25, 2000)) motion.push_back(pose);
  double theta_rad = 25 * kDegree;
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
