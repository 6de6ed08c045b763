// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Steps the torque model, for count_instructions.cmake to count what a step takes:
//   torque_steps closing    a haptic loop of 1 kHz: two blades, both policies, closing at 6 deg/s
//   torque_steps anything   random jumps of blades and pivot, wavy blades, extreme plates
#include <cstdio>
#include <string_view>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

void Close() {
  for (const DeltaPolicy policy : {DeltaPolicy::kConstant, DeltaPolicy::kCriterion}) {
    TorqueModel tapered(SmallMetzenbaum(), PaperMaterials()[0], {45, 68}, {policy});
    TorqueModel spline(CurvedBlade(), PaperMaterials()[0], {25, 60}, {policy});
    for (const Pose& pose : StraightMotion(26, 20, 1000)) {
      static_cast<void>(tapered.Step(pose.theta_rad, 0, 1e-3));
      static_cast<void>(spline.Step(pose.theta_rad, 0, 1e-3));
    }
  }
}

void DoAnything() {
  std::mt19937 random(1);
  for (int scene = 0; scene < 60; ++scene) {
    const Material plate{"any",
                         LogUniform(random, 1e-6, 1e6),
                         LogUniform(random, 1e-6, 1e2),
                         ForceDeflection(LogUniform(random, 1e-6, 1e9))};
    const DeltaPolicy policy = scene % 2 == 0 ? DeltaPolicy::kConstant : DeltaPolicy::kCriterion;
    TorqueModel model(RandomWavyBlade(random), plate, {25, 75}, {policy});
    for (int i = 0; i < 50; ++i) {
      const double pivot_mm = random() % 3 == 0 ? Uniform(random, -40, 40) : 0;
      static_cast<void>(model.Step(Uniform(random, -0.3, 1.5), pivot_mm, 1e-3));
    }
  }
}

}  // namespace
}  // namespace bladecurve

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "closing") {
    bladecurve::Close();
  } else if (what == "anything") {
    bladecurve::DoAnything();
  } else {
    std::fprintf(stderr, "usage: torque_steps closing|anything\n");
    return 2;
  }
  return 0;
}
