// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/image/tone_curve.h"
#include "vision/pivot/screw.h"

namespace bladecurve {

// Heads of which nothing but the slot shows, as of flush screws and against the light: straight
// bars, dark or bright, as long as heads of the searched sizes are wide, both ends of which are
// seen. Lines of joints and engraved letters may look like them: something else must speak for a
// head.
[[nodiscard]] std::vector<Screw> FindSlottedHeads(const cv::Mat& grey,
                                                  const ToneCurve& tone,
                                                  const ScrewSearch& search);

}  // namespace bladecurve
