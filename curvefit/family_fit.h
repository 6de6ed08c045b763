// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "curvefit/fit.h"
#include "curvefit/fit_data.h"
#include "curvefit/joint_fit.h"

namespace bladecurve {

// What a family's fit needs and what both families share.
struct FamilyInput {
  const FitData& data;       // cleaned
  std::vector<bool> mirror;  // lower edges that may be used
  CurveDomain domain;        // of the curve, mm
};

// The rigid spline of the given space, from `start`.
[[nodiscard]] FamilyFit FitSpline(const FamilyInput& input,
                                  const SplineSpace& space,
                                  const JointState& start,
                                  Loss loss);

// The tapered form; gain nullopt: free. A gain that the photographs do not determine is held at 1/2
// and listed in `undetermined`.
[[nodiscard]] FamilyFit FitTapered(const FamilyInput& input, const std::optional<double>& gain);

// The gain that photographs at several angles have themselves; not set if they do not determine it.
[[nodiscard]] GainFinding FindGain(const FamilyInput& input);

}  // namespace bladecurve
