// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "curvefit/bspline.h"
#include "curvefit/fit_data.h"
#include "curvefit/joint_fit.h"

namespace bladecurve {

// How far the lower edge of a photograph may be taken for the mirror image of its upper one.
struct MirrorVerdict {
  bool use = false;
  double sigma_scale =
      1;  // the lower edge's sigmas times this hold the difference between the blades
};

// One verdict a photograph, each by itself. The upper edge is never at stake: where the blades
// differ (parallax, sheen, a blade ground differently), or only a pivot elsewhere than it was seen
// makes them alike, the lower edge's sigmas grow until the rest is what noise makes on average;
// where they differ by more than a hundredth of the blade's length, the lower blade has a shape of
// its own and only its distal end counts.
[[nodiscard]] std::vector<MirrorVerdict> JudgeMirrors(const FitData& data,
                                                      const SplineSpace& space,
                                                      Loss loss);

}  // namespace bladecurve
