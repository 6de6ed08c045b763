// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// Where somebody points to a thing, px, and how far about that it likely is the thing.
struct PointedAt {
  cv::Point place;
  double about_px = 0;
};

// What is pointed at, whatever the pattern of the ground: mixtures of the colours of both, and the
// cheapest outline between them (Rother, Kolmogorov and Blake 2004, "GrabCut"). CV_8UC1, 0 or 255;
// bgr: CV_8UC3. What reaches the picture's border goes on through it. The same picture gives the
// same mask.
[[nodiscard]] cv::Mat CutOut(const cv::Mat& bgr, const PointedAt& thing);

}  // namespace bladecurve
