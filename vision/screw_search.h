// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/screw.h"
#include "vision/screw_rim.h"

namespace bladecurve {

// Flatter: half a head cut off by its slot, not a tilted circle.
inline constexpr double kLeastAxisRatio = 0.75;

// A rim that may be the head's, and the logarithm of the odds that it is one.
struct FoundRim {
  RimFit fit;  // in picture pixels
  double evidence = 0;
  double unlike_view = 0;  // what speaks against it beside others of the same head
  [[nodiscard]] double Preference() const { return evidence - unlike_view; }
};

// All rims of all sizes within the search, the best first; of the best also those that lie around
// it and compete with it.
[[nodiscard]] std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search);

}  // namespace bladecurve
