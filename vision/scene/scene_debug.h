// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/scene/scene_candidate.h"

namespace bladecurve {

// The small picture beside the mask, with the contour's named parts: inner edges, tips, crotches,
// pivot. CV_8UC3.
[[nodiscard]] cv::Mat DrawScene(const Candidate& found, const Scene& scene);

// What a rung of the ladder saw: the brighter the further from the background (logarithm), with the
// inner edges and the pivot of every candidate, the better the brighter. CV_8UC3.
[[nodiscard]] cv::Mat DrawRung(const Rung& rung);

}  // namespace bladecurve
