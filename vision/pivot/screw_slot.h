// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/tone_curve.h"
#include "vision/pivot/screw.h"

namespace bladecurve {

// The dark slot of a head about center_px of radius_px, both good to a fifth of the radius;
// std::nullopt where there is none with confidence.
[[nodiscard]] std::optional<ScrewSlot> FindSlot(const cv::Mat& grey,
                                                const ToneCurve& tone,
                                                const Eigen::Vector2d& center_px,
                                                double radius_px);

}  // namespace bladecurve
