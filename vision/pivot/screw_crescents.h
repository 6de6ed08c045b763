// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/pivot/screw_rim.h"

namespace bladecurve {

// A head that stands up has a bright crescent along its chamfer on the side that a lamp or the sun
// lights, and on the other side a dark one, as wide as the chamfer and what shadow it casts. A rim
// that rises all round, or falls, is followed along the inner border of the one and the outer
// border of the other, and lies aside of the head by half of what parts them. Takes the rim's
// centre back as far as the crescents tell, and counts the rest in its covariance, along the light.
// The same rim where there are none; where several lamps put glints there, as LeaveGlints has it.
// light: CV_32F, linear, at full resolution.
[[nodiscard]] RimFit LeaveCrescents(const cv::Mat& light, RimFit fit);

}  // namespace bladecurve
