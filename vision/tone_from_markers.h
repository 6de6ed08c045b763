// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/scale.h"
#include "vision/tone_curve.h"

namespace bladecurve {

// The tone curve sRGB^p, with p such that the sides of the markers are blurred alike towards black
// and towards white in linear light; nothing else is assumed about the blur. p = 1 where the sides
// do not contradict it. The sRGB curve, marked as not measured, where the sides say too little:
// small, sharp or overexposed markers.
[[nodiscard]] ToneCurve MeasureToneCurve(const cv::Mat& grey,
                                         const std::vector<SeenMarker>& markers);

// sRGB raised to a power: 1 is sRGB itself, 1 / 2.2 nearly linear.
[[nodiscard]] ToneCurve PowerToneCurve(double power);

}  // namespace bladecurve
