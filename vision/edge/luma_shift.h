// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// What a grey picture, mixed of stored values (ITU-R BT.601), makes of coloured light; linear
// (BGR).
[[nodiscard]] double LightInGrey(const Eigen::Vector3d& bgr, const ToneCurve& tone);

// Blur mixes light; grey pictures mix stored values, which are not light. So a grey edge between two
// colours lies elsewhere than the step of light that was blurred: so far from it towards the second
// colour, in standard deviations of the blur; least squares over the step. 0 for greys of any
// lightness; at most a half, where the colours hardly differ in grey. Colours: linear light (BGR).
[[nodiscard]] double LumaShift(const Eigen::Vector3d& from,
                               const Eigen::Vector3d& to,
                               const ToneCurve& tone);

}  // namespace bladecurve
