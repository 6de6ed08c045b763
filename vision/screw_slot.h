// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/tone_curve.h"

namespace bladecurve {

// What the slot of a screw says of its head's centre: it runs through it, and is cut from rim to
// rim. Independent of the rim, where a chamfer that is bright on one side and dark on the other, or
// a recess, may lead a fit astray.
struct ScrewSlot {
  Eigen::Vector2d center_px;
  Eigen::Matrix2d covariance_px2;  // much larger along the slot than across it
  bool ends_seen = false;          // both, at the rim
};

// The dark slot of a head about center_px of radius_px, both good to a fifth of the radius;
// std::nullopt where there is none with confidence.
[[nodiscard]] std::optional<ScrewSlot> FindSlot(const cv::Mat& grey,
                                                const ToneCurve& tone,
                                                const Eigen::Vector2d& center_px,
                                                double radius_px);

}  // namespace bladecurve
