// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/edge/edge.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// A strip along the inner side of the edge of dark metal before bright ground, a few pixels wide
// and of a light between the two: the ground in a shadow that the blade casts, or a border of the
// blade that mirrors the ground.
struct Tread {
  double begins_px = 0;  // from the edge, negative: within it
  double width_px = 0;
  double share = 0;  // of the ground's light
};

// By two steps, blurred alike, that explain the light across the edge much better than a single one
// does. std::nullopt where they do not, or the edge is not that of dark metal. grey: CV_8UC1.
[[nodiscard]] std::optional<Tread> FindTread(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const LocatedEdge& edge);

}  // namespace bladecurve
