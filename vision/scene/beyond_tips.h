// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/scene/blades.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {

// Whether other things lie soon beyond both tips and go on there, as the rest of shanks does, or
// their rings, of whose outline some was lost. Where the frame cuts the other ends, which may be
// the blades, beyond one tip is enough, if that limb does not taper. mask: what `silhouette` is one
// thing of.
[[nodiscard]] bool GoOnBeyondTips(const cv::Mat& mask,
                                  const Silhouette& silhouette,
                                  const BladePair& pair);

}  // namespace bladecurve
