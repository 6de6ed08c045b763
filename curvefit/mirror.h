// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "curvefit/fit_data.h"
#include "curvefit/joint_fit.h"

namespace bladecurve {

// How far the lower edges may be taken for mirror images of the upper ones.
struct MirrorVerdict {
  std::vector<bool> use;  // by photograph
  std::vector<double>
      sigma_scale;   // its lower edge's sigmas times this hold the difference between the blades
  JointState state;  // the fit that goes with it
};

// The upper edge is never at stake: where the blades differ (parallax, sheen, a blade ground
// differently) the lower edge's sigmas grow until the difference is as likely as noise; where they
// differ by more than a hundredth of the blade's length, the lower blade has a shape of its own and
// only its distal end counts.
[[nodiscard]] MirrorVerdict JudgeMirror(const FitData& data,
                                        const SplineSpace& space,
                                        Loss loss,
                                        const JointState& start);

}  // namespace bladecurve
