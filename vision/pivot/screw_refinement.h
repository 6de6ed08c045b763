// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/tone_curve.h"
#include "vision/pivot/screw_rim.h"

namespace bladecurve {

// The rim of a screw's head in linear light at full resolution, all in picture pixels. Shading
// within the head and the grain of the metal are modelled where that tells the rim better; the
// covariance counts also what light from one side does to all of the rim. `view` as in ScrewSearch.
// `judged` itself, with that covariance, where the fit leaves it.
[[nodiscard]] RimFit RefineRim(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const RimFit& judged,
                               const std::optional<Eigen::Matrix2d>& view);

}  // namespace bladecurve
