// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

#include "samples/analysis.h"

namespace bladecurve {

// The picture that shows whether photograph `index` was understood; decodes it once more for its
// colours. Throws std::invalid_argument if it was not kept (MeasureOptions::keep_photo).
[[nodiscard]] cv::Mat DrawFitOverlay(const Analysis& analysis, std::size_t index);

}  // namespace bladecurve
