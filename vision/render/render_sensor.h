// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "vision/render/synthetic_scene.h"

namespace bladecurve::render {

// Linear light to the stored value, both 0 to 1: sRGB (IEC 61966-2-1) or x^(1/gamma). Light beyond
// 1 clips.
[[nodiscard]] double Encode(double linear, const SensorSpec& sensor);

// Linear RGB (CV_32FC3) to 8-bit BGR: tone curve, then noise alike in all channels (it is the
// luma's that matters), then rounding. The noise depends on seed and place alone.
[[nodiscard]] cv::Mat3b Develop(const cv::Mat3f& linear_rgb,
                                const SensorSpec& sensor,
                                std::uint64_t seed);

}  // namespace bladecurve::render
