// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/scene/blades.h"

namespace bladecurve {

// How many limbs go out from the pivot on the blades' side, each as far as blades do: two, unless
// blades of another instrument cross there. filled: CV_8UC1, the silhouette of the pair, its holes
// filled.
[[nodiscard]] int CountLimbsAhead(const cv::Mat& filled, const BladePair& pair);

}  // namespace bladecurve
