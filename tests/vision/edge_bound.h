// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bladecurve::testing {

// A straight blurred edge as a camera with square pixels and Gaussian noise sees it.
struct BoundCase {
  double length_px = 300;
  double blur_px = 1, contrast = 120, noise = 2;
  double normal_rad = 0.1;  // direction of the normal against the x axis
  double reach_px = 6;      // pixels used on either side
};

// Cramér-Rao bound on the standard deviation of the edge's offset at its middle, px; angle, both
// levels and blur are unknown too and paid for. Fisher information summed over the pixels,
// derivatives by central differences of the quadrature model in edge_images.h.
[[nodiscard]] double OffsetBound(const BoundCase& edge);

}  // namespace bladecurve::testing
