// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/edge/edge.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// Typical linear light along an edge at a distance from it, positive out of the blade. Not near the
// crotch, where the other blade is close. std::nullopt beyond the picture. grey: CV_8UC1.
[[nodiscard]] std::optional<double> TypicalLight(const cv::Mat& grey,
                                                 const ToneCurve& tone,
                                                 const LocatedEdge& edge,
                                                 double across_px);

}  // namespace bladecurve
