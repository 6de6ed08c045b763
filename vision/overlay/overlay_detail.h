// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/overlay/overlay.h"

namespace bladecurve {

// Index of the located point that is furthest from the fitted curve.
[[nodiscard]] std::size_t WorstPoint(const Overlay& overlay);

// The photograph straightened along the fitted curve: along it to fit the width of `image`, across
// it `half_band_px` photograph pixels to either side. Located points lie beside the straight curve.
void DrawStraightenedEdge(const Photo& photo,
                          const Overlay& overlay,
                          double half_band_px,
                          cv::Mat image);

// The surroundings of the worst point, `half_px` to every side, in whole pixels as the camera gave
// them.
void DrawWorstPlace(const Photo& photo, const Overlay& overlay, double half_px, cv::Mat image);

}  // namespace bladecurve
