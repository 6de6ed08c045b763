// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/scene_ladder.h"

namespace bladecurve {

// The small picture beside the mask, with the contour's named parts: inner edges, tips, crotches,
// pivot. CV_8UC3.
[[nodiscard]] cv::Mat DrawScene(const Candidate& found, const Scene& scene);

}  // namespace bladecurve
