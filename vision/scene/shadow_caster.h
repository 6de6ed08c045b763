// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

// Of things that stand out in several tones, what casts the others as its shadow: masks of it
// (CV_8UC1) with the borders between the tones placed in several ways. None where the tones are not
// apart, or one is not the shadow of the rest: sun or a lamp moves the shadow of flat things aside
// by much the same everywhere, so it is their own image, moved, as far as they do not cover it.
// `lightness` (CV_32FC1): 0 on the ground, of which the things (CV_8UC1) stand out. `coloured`
// (CV_8UC1): what is no shadow, of whatever tone; all 0 where that is not known.
[[nodiscard]] std::vector<cv::Mat> MasksOfShadowCaster(const cv::Mat& lightness,
                                                       const cv::Mat& things,
                                                       const cv::Mat& coloured);

}  // namespace bladecurve
