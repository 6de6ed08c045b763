// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/scale/marker_model.h"
#include "vision/scale/marker_pixels.h"

namespace bladecurve {

// Which marker is to be fitted, and from where: what little is known beforehand of the start keeps
// in place what the pixels do not tell.
struct MarkerProblem {
  const InkCells& ink;
  const MarkerFrame& frame;
  const MarkerVector& start;
};

struct MarkerMinimum {
  MarkerVector at;
  MarkerMatrix information;  // Gauss-Newton's, for residuals of unit variance
};

// The marker that leaves the least squares of light over the pixels, sought from `at` on by
// Levenberg-Marquardt.
[[nodiscard]] MarkerMinimum MinimiseMarker(const MarkerProblem& problem,
                                           const std::vector<MarkerPixel>& pixels,
                                           MarkerVector at);

}  // namespace bladecurve
