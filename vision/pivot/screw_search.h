// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/pivot/screw.h"
#include "vision/pivot/screw_rim.h"

namespace bladecurve {

// Flatter: half a head cut off by its slot, not a tilted circle.
inline constexpr double kLeastAxisRatio = 0.75;

// A rim that may be the head's; natural logarithms of odds.
struct FoundRim {
  RimFit fit;              // in picture pixels
  double evidence = 0;     // that it is a head's at all
  double preference = 0;   // beside other rims of the same head
  bool one_sided = false;  // a third of it does not show at all, as of tips and corners
};

// Whether both may be rims of the same head, or one and the same.
[[nodiscard]] bool OfOneHead(const RimEllipse& a, const RimEllipse& b);

// All rims of all sizes within the search: those of the most evident head, the preferred one first
// and with that evidence; then the others.
[[nodiscard]] std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search);

}  // namespace bladecurve
