// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Accuracy and time of the real-time step side by side.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "model/torque.h"
#include "tests/model/cutting_oracle.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

struct Case {
  const char* name;
  BladeCurve blade;
  PlateSpan span;
  DeltaPolicy policy;
};

std::vector<Case> Cases() {
  return {{"tapered, constant", SmallMetzenbaum(), {45, 68}, DeltaPolicy::kConstant},
          {"tapered, criterion", SmallMetzenbaum(), {45, 68}, DeltaPolicy::kCriterion},
          {"spline, constant", CurvedBlade(), {25, 60}, DeltaPolicy::kConstant},
          {"spline, criterion", CurvedBlade(), {25, 60}, DeltaPolicy::kCriterion}};
}

double TorqueError(const Case& c) {
  const Material material = PaperMaterials()[0];
  TorqueModel model(c.blade, material, c.span, {c.policy});
  CuttingOracle oracle(c.blade, material, c.span, c.policy, 1);
  double worst = 0, largest = 0;
  for (const Pose& pose : StraightMotion(30, 6, 120)) {
    const double torque_nmm = model.Step(pose.theta_rad, 0, 1e-3).torque_nmm;
    const auto truth_nmm = static_cast<double>(oracle.Step(pose.theta_rad, 0).torque_nmm);
    worst = std::max(worst, std::abs(torque_nmm - truth_nmm));
    largest = std::max(largest, truth_nmm);
  }
  return worst / largest;
}

// Nanoseconds of each step of a closing cut at 1 kHz, the cost of the clock taken off.
std::vector<double> StepTimes(const Case& c) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times_ns;
  const std::vector<Pose> motion = StraightMotion(30, 0, 10000);
  for (int repeat = 0; repeat < 10; ++repeat) {
    TorqueModel model(c.blade, PaperMaterials()[0], c.span, {c.policy});
    for (const Pose& pose : motion) {
      const auto start = Clock::now();
      const auto empty = Clock::now();
      static_cast<void>(model.Step(pose.theta_rad, pose.pivot_mm, 1e-3));
      const auto end = Clock::now();
      times_ns.push_back(
          std::chrono::duration<double, std::nano>((end - empty) - (empty - start)).count());
    }
  }
  std::sort(times_ns.begin(), times_ns.end());
  return times_ns;
}

void PrintTable() {
  std::printf("%-20s %14s %10s %10s %10s\n", "step", "torque error", "p50 ns", "p99 ns", "max ns");
  for (const Case& c : Cases()) {
    const std::vector<double> ns = StepTimes(c);
    std::printf("%-20s %14.1e %10.0f %10.0f %10.0f\n",
                c.name,
                TorqueError(c),
                ns[ns.size() / 2],
                ns[ns.size() * 99 / 100],
                ns.back());
  }
}

}  // namespace
}  // namespace bladecurve

int main() {
  bladecurve::PrintTable();
  return 0;
}
