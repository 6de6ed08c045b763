// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/scene/blades.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {

// Whether other things lie soon beyond both tips and go on there, as the rest of shanks does, or
// their rings, of whose outline some was lost. mask: what `silhouette` is one thing of.
[[nodiscard]] bool BothGoOnBeyondTips(const cv::Mat& mask,
                                      const Silhouette& silhouette,
                                      const BladePair& pair);

}  // namespace bladecurve
