// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/straight_edge.h"
#include "vision/tone_curve.h"

namespace bladecurve {

// The sides of a dark square on light paper, side k from corner k to the next, clockwise: the
// inside lies along their normals.
using SquareSides = std::array<StraightEdge, 4>;

// The sides anew by maximum likelihood on all pixels within free_px of them, corners included: one
// blur, one light of ink and paper that may fall off over the square, instead of one for each side.
// Sides keep their bow. std::nullopt where a side is partly covered, or the fit leaves the sides it
// began with.
[[nodiscard]] std::optional<SquareSides> FitSquare(const cv::Mat& grey,
                                                   const ToneCurve& tone,
                                                   const SquareSides& sides,
                                                   double free_px);

}  // namespace bladecurve
