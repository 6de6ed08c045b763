// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/pivot/screw.h"
#include "vision/pivot/screw_ellipse.h"
#include "vision/pivot/screw_evidence.h"

namespace bladecurve {

// Whether both may be rims of the same head, or one and the same.
[[nodiscard]] bool OfOneHead(const RimEllipse& a, const RimEllipse& b);

// Rims within the search, of sizes from the smallest up to those of a head beyond mistake: the most
// evident head's, the preferred one first and with that evidence; then the others.
[[nodiscard]] std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search);

}  // namespace bladecurve
