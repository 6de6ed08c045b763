// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "samples/cut_run.h"

namespace bladecurve {

// A self-contained SVG of the torque over the opening angle (closing runs to the right): phases
// coloured and named, events marked.
[[nodiscard]] std::string TorquePlotSvg(const CutRun& run, const std::string& title);

// The same as a bitmap, CV_8UC3 (BGR), of twice as many pixels.
[[nodiscard]] cv::Mat TorquePlotBitmap(const CutRun& run, const std::string& title);

}  // namespace bladecurve
