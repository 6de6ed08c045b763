// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/scene/silhouette.h"

namespace bladecurve {

// Handles that touch, or overlap, close the gap between the shanks: it is a slender hole of the
// mask then. The silhouette with such a hole opened to an inlet of its outline that lies in line
// with it, once for each such pair, at most a few.
[[nodiscard]] std::vector<Silhouette> WithHandlesParted(const cv::Mat& mask,
                                                        const Silhouette& silhouette);

}  // namespace bladecurve
