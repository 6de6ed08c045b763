// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The torque model against closed forms and its own definitions.
#include "model/torque.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

constexpr double kClosedForm = 1e-9;  // relative, and rad: what the closed forms must be met within
constexpr double kA_mm = -11;

double SlopeAt(double b, double theta_rad) { return b + 0.5 * std::tan(theta_rad / 2); }

// theta at which the edge of a tapered rectangle passes (x, y).
double AngleThrough(double b, double x_mm, double y_mm) {
  return 2 * std::atan(2 * ((y_mm - kA_mm) / x_mm - b));
}

// Elastic minus cutting torque at the plate's edge, from the formulas alone.
double Excess(double b, const Material& m, double theta_rad) {
  const double slope = SlopeAt(b, theta_rad);
  const double delta_mm = m.thickness_mm / 2 - kA_mm - kCutSpan.edge_mm * slope;
  const double lever_mm = kCutSpan.edge_mm * std::cos(theta_rad / 2 - std::atan(slope));
  const double secant = 1 / std::cos(theta_rad / 2);
  return lever_mm * m.force_deflection.initial_stiffness_n_per_mm() * delta_mm -
         m.toughness_n_per_mm * m.thickness_mm * kCutSpan.edge_mm * secant * secant / (4 * slope);
}

double StartAngle(double b, const Material& m) {
  double high = AngleThrough(b, kCutSpan.edge_mm, m.thickness_mm / 2), low = 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (Excess(b, m, middle) >= 0 ? low : high) = middle;
  }
  return low;
}

struct Events {
  double contact_rad = std::numeric_limits<double>::quiet_NaN();
  double start_rad = std::numeric_limits<double>::quiet_NaN();
  double stop_jump = std::numeric_limits<double>::quiet_NaN();
  double through_rad = std::numeric_limits<double>::quiet_NaN();
};

void Note(const TorqueModel& model, Events& events) {
  for (const TorqueEvent& event : model.events()) {
    if (event.kind == TorqueEventKind::kContact) events.contact_rad = event.theta_rad;
    if (event.kind == TorqueEventKind::kCutStart) events.start_rad = event.theta_rad;
    if (event.kind == TorqueEventKind::kThrough) events.through_rad = event.theta_rad;
    if (event.kind == TorqueEventKind::kCutStop)
      events.stop_jump = event.torque_after_nmm - event.torque_before_nmm;
  }
}

void ExpectClosedForms(const BladeCurve& blade, double b, const Material& material, int steps) {
  TorqueModel model(blade, material, kCutSpan);
  const double start_rad = StartAngle(b, material);
  const double y_c_mm = kA_mm + kCutSpan.edge_mm * SlopeAt(b, start_rad);  // h/2 - delta_c
  Events events;
  for (const Pose& pose : StraightMotion(35, 0, steps)) {
    const TorqueSample sample = model.Step(pose.theta_rad, 0, 0.01);
    Note(model, events);
    if (sample.phase != Phase::kCutting) continue;
    const double slope = SlopeAt(b, pose.theta_rad);
    const double secant = 1 / std::cos(pose.theta_rad / 2);
    const double torque_nmm = material.toughness_n_per_mm * material.thickness_mm *
                              (y_c_mm - kA_mm) * secant * secant / (4 * slope * slope);
    EXPECT_NEAR(sample.torque_nmm / torque_nmm, 1, kClosedForm)
        << material.name << " at " << pose.theta_rad;
    EXPECT_NEAR(sample.x_c_mm * slope / (y_c_mm - kA_mm), 1, kClosedForm)
        << material.name << " at " << pose.theta_rad;
    EXPECT_EQ(sample.flags, 0u);
  }
  EXPECT_NEAR(events.contact_rad,
              AngleThrough(b, kCutSpan.edge_mm, material.thickness_mm / 2),
              kClosedForm);
  EXPECT_NEAR(events.start_rad, start_rad, kClosedForm) << material.name;
  EXPECT_NEAR(events.through_rad, AngleThrough(b, kCutSpan.end_mm, y_c_mm), kClosedForm)
      << material.name;
  const double work_nmm =
      material.toughness_n_per_mm * material.thickness_mm * (kCutSpan.end_mm - kCutSpan.edge_mm);
  EXPECT_NEAR(model.ledger().cut_work_nmm / work_nmm, 1, kClosedForm)
      << material.name << ", steps " << steps;
}

TEST(TorqueModel, MeetsTheClosedFormsOfBothScissorsInAllMaterials) {
  for (const Material& material : PaperMaterials()) {
    ExpectClosedForms(SmallMetzenbaum(), 0.14, material, 10000);
    ExpectClosedForms(LargeMetzenbaum(), 0.12, material, 10000);
  }
}

TEST(TorqueModel, MeetsTheClosedFormsAlsoInFewLongSteps) {
  for (const Material& material : PaperMaterials())
    ExpectClosedForms(SmallMetzenbaum(), 0.14, material, 50);
}

TEST(TorqueModel, PassesItsPhasesInOrder) {
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], kCutSpan);
  std::vector<Phase> phases;
  for (const TorqueSample& sample : Replay(model, StraightMotion(30, 0, 3000))) {
    if (phases.empty() || phases.back() != sample.phase) phases.push_back(sample.phase);
  }
  EXPECT_EQ(
      phases,
      (std::vector<Phase>{Phase::kNone, Phase::kDeformation, Phase::kCutting, Phase::kThrough}));
}

TEST(TorqueModel, OfConstantDeltaJumpsDownWhereTheBladesOpenAndCutsAgainFurtherOn) {
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], kCutSpan);
  Events events;
  double crack_mm = 0;
  for (const Pose& pose : StraightMotion(30, 10, 2000))
    crack_mm = model.Step(pose.theta_rad, 0, 1e-3).x_c_mm;
  for (const Pose& pose : StraightMotion(10, 20, 1000)) {
    const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
    Note(model, events);
    EXPECT_EQ(sample.x_c_mm, crack_mm) << "the crack healed";
    EXPECT_TRUE(pose.theta_rad <= 10 * kDegree || sample.phase != Phase::kCutting);
  }
  EXPECT_LT(events.stop_jump, 0);
  events = {};
  for (const Pose& pose : StraightMotion(20, 5, 1500)) {
    static_cast<void>(model.Step(pose.theta_rad, 0, 1e-3));
    Note(model, events);
  }
  EXPECT_LT(events.start_rad, 10 * kDegree);
}

TEST(TorqueModel, OfTheCriterionIsContinuousWhereTheBladesOpenAndClose) {
  for (const Material& material : PaperMaterials()) {
    TorqueModel model(SmallMetzenbaum(), material, kCutSpan, {DeltaPolicy::kCriterion});
    Events events;
    for (const Pose& pose : StraightMotion(30, 10, 2000))
      static_cast<void>(model.Step(pose.theta_rad, 0, 1e-3));
    const double torque_nmm = model.Step(10 * kDegree, 0, 1e-3).torque_nmm;
    for (const Pose& pose : StraightMotion(10, 20, 1000)) {
      static_cast<void>(model.Step(pose.theta_rad, 0, 1e-3));
      Note(model, events);
    }
    EXPECT_NEAR(events.stop_jump / torque_nmm, 0, kClosedForm) << material.name;
    for (const Pose& pose : StraightMotion(20, 9, 1100)) {
      static_cast<void>(model.Step(pose.theta_rad, 0, 1e-3));
      Note(model, events);
    }
    EXPECT_NEAR(events.start_rad, 10 * kDegree, kClosedForm) << material.name;
  }
}

TEST(TorqueModel, KeepsTheAverageTorqueOfCutting) {
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], kCutSpan);
  double sum_nmm = 0, turn_rad = 0;
  TorqueSample last;
  constexpr int kSteps = 20000;
  for (const Pose& pose : StraightMotion(30, 10, kSteps)) {
    const TorqueSample sample = model.Step(pose.theta_rad, 0, 1e-3);
    if (sample.phase == Phase::kCutting && last.phase == Phase::kCutting) {
      sum_nmm += 0.5 * (sample.torque_nmm + last.torque_nmm);
      turn_rad += 20 * kDegree / kSteps;
    }
    last = sample;
  }
  constexpr double kOneStep = 1e-4;  // the cut starts within one
  EXPECT_NEAR(model.ledger().cut_turn_rad / turn_rad, 1, kOneStep);
  const double average_nmm = model.ledger().cut_work_nmm / model.ledger().cut_turn_rad;
  EXPECT_NEAR(average_nmm * turn_rad / (sum_nmm * 20 * kDegree / kSteps), 1, kOneStep);
}

TEST(TorqueModel, SlicesWithConstantTorqueAndForceAtAConstantAngle) {
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[1], kCutSpan);
  TorqueSample first;
  for (const Pose& pose : StraightMotion(30, 15, 1500)) first = model.Step(pose.theta_rad, 0, 1e-3);
  ASSERT_EQ(first.phase, Phase::kCutting);
  const double slope = SlopeAt(0.14, 15 * kDegree);
  const double alpha = 7.5 * kDegree - std::atan(slope);
  EXPECT_NEAR(
      first.force_x_n,
      -first.torque_nmm / (first.x_c_mm * std::cos(alpha)) * std::sin(7.5 * kDegree - alpha),
      kClosedForm);
  for (int i = 1; i <= 500; ++i) {
    const TorqueSample sample = model.Step(15 * kDegree, 0.01 * i, 1e-3);
    EXPECT_EQ(sample.phase, Phase::kCutting);
    EXPECT_NEAR(sample.torque_nmm / first.torque_nmm, 1, kClosedForm);
    EXPECT_NEAR(sample.force_x_n / first.force_x_n, 1, kClosedForm);
  }
  EXPECT_NEAR(model.ledger().pivot_advance_mm, 5, kClosedForm);
}

TEST(TorqueModel, OfATabulatedStraightLineEqualsTheLinearOne) {
  const Material linear = PaperMaterials()[2];
  const double k = linear.force_deflection.initial_stiffness_n_per_mm();
  Material tabulated = linear;
  tabulated.force_deflection =
      ForceDeflection({0, 0.1, 0.35, 1, 5}, {0, 0.1 * k, 0.35 * k, k, 5 * k});
  TorqueModel a(SmallMetzenbaum(), linear, kCutSpan), b(SmallMetzenbaum(), tabulated, kCutSpan);
  for (const Pose& pose : RandomMotion(5, 400, true)) {
    const TorqueSample sample_a = a.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
    const TorqueSample sample_b = b.Step(pose.theta_rad, pose.pivot_mm, 1e-3);
    EXPECT_EQ(sample_a.phase, sample_b.phase);
    EXPECT_NEAR(sample_a.torque_nmm, sample_b.torque_nmm, 1e-9);
  }
}

bool SameBits(const TorqueSample& a, const TorqueSample& b) {
  return std::memcmp(&a.torque_nmm, &b.torque_nmm, sizeof(double)) == 0 &&
         std::memcmp(&a.force_x_n, &b.force_x_n, sizeof(double)) == 0 &&
         std::memcmp(&a.x_c_mm, &b.x_c_mm, sizeof(double)) == 0 && a.phase == b.phase &&
         a.flags == b.flags;
}

TEST(TorqueModel, ReplaysToTheSameBitsAfterAReset) {
  TorqueModel model(CurvedBlade(), PaperMaterials()[3], kCutSpan);
  const std::vector<Pose> motion = RandomMotion(11, 500, true);
  const std::vector<TorqueSample> first = Replay(model, motion);
  model.Reset();
  const std::vector<TorqueSample> second = Replay(model, motion);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_TRUE(SameBits(first[i], second[i])) << i;
}

TEST(TorqueModel, InstancesShareNothing) {
  TorqueModel alone(SmallMetzenbaum(), PaperMaterials()[0], kCutSpan), other(alone);
  const std::vector<Pose> motion = RandomMotion(3, 300, true),
                          distraction = RandomMotion(4, 300, false);
  const std::vector<TorqueSample> expected = Replay(alone, motion);
  TorqueModel interleaved(SmallMetzenbaum(), PaperMaterials()[0], kCutSpan);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    static_cast<void>(other.Step(distraction[i].theta_rad, distraction[i].pivot_mm, 1e-3));
    EXPECT_TRUE(
        SameBits(interleaved.Step(motion[i].theta_rad, motion[i].pivot_mm, 1e-3), expected[i]));
  }
}

TEST(TorqueModel, NamesWhatCannotBe) {
  const Material paper = PaperMaterials()[0];
  EXPECT_THROW(TorqueModel(SmallMetzenbaum(), paper, {68, 45}), std::invalid_argument);
  EXPECT_THROW(TorqueModel(SmallMetzenbaum(), paper, {45, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(TorqueModel(SmallMetzenbaum(), paper, kCutSpan, {DeltaPolicy::kConstant, 0.0}),
               std::invalid_argument);
  Material without_toughness = paper;
  without_toughness.toughness_n_per_mm = 0;
  EXPECT_THROW(TorqueModel(SmallMetzenbaum(), without_toughness, kCutSpan), std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
