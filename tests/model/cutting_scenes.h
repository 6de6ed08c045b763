// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "model/torque.h"
#include "tests/degree.h"
#include "tests/model/uniform.h"

namespace bladecurve {

// The paper's scissors and plates, curved blades, and motions to cut with: what the tests of the
// torque share.

constexpr PlateSpan kCutSpan{45, 68};

[[nodiscard]] BladeCurve SmallMetzenbaum();  // a = -11, b = 0.14
[[nodiscard]] BladeCurve LargeMetzenbaum();  // a = -11, b = 0.12
[[nodiscard]] std::vector<Material> PaperMaterials();

// A cubic edge, bent outwards and back, in the blade's own frame.
[[nodiscard]] BladeCurve CurvedBlade();

// An edge that rises, dips by chance and rises again: several x have the same phi.
[[nodiscard]] BladeCurve RandomWavyBlade(std::mt19937& random);

struct Pose {
  double theta_rad = 0, pivot_mm = 0;
};

// From 30 degrees: closes on the whole, opens again now and then; with slicing the pivot wanders up
// to 15 mm forward.
[[nodiscard]] std::vector<Pose> RandomMotion(std::uint32_t seed, int samples, bool slicing);

// From angle to angle in `steps` equal steps.
[[nodiscard]] std::vector<Pose> StraightMotion(double from_deg, double to_deg, int steps);

// Torque of a whole motion, at `dt_s` a sample.
[[nodiscard]] std::vector<TorqueSample> Replay(TorqueModel& model,
                                               const std::vector<Pose>& motion,
                                               double dt_s = 1e-3);

}  // namespace bladecurve
