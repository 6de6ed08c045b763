// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/tone_curve.h"
#include "vision/scale/camera.h"
#include "vision/scale/scale.h"

namespace bladecurve {

// A marker anew by maximum likelihood on the pixels about all its borders, those of its pattern
// included: the size is that of its cells, so that neither overexposed paper nor ink that has run
// changes it. `start`: corners within a pixel or so, and the blur. std::nullopt where what is seen
// is not that pattern of ink on paper, a fifth of it is covered, or the corners leave the start.
[[nodiscard]] std::optional<SeenMarker> FitMarker(const cv::Mat& grey,
                                                  const ToneCurve& tone,
                                                  const SeenMarker& start,
                                                  const std::optional<Camera>& camera);

}  // namespace bladecurve
