// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/scene/blades.h"

namespace bladecurve {

// Whether both shanks carry a catch, as those of clamps and needle holders do and of scissors do
// not: each is wide for a short way before its ring begins, both at like distance from where they
// part. filled: CV_8UC1, the silhouette of the pair, its holes filled.
[[nodiscard]] bool ShanksCarryCatches(const cv::Mat& filled, const BladePair& pair);

}  // namespace bladecurve
