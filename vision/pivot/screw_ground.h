// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {

// The CV_32F picture of light with the ground about a head made even, as far as it shows beside the
// rim: without its shading, a quadratic of place, and without the streaks of its brushing, which
// go on away from the rim and are known from there. Both would draw the rim aside, as they are
// alike all along an arc of it.
[[nodiscard]] cv::Mat WithEvenGround(const cv::Mat& picture, const RimEllipse& rim);

}  // namespace bladecurve
