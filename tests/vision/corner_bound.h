// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/square_images.h"

namespace bladecurve {

// Cramér-Rao bound, px, of one coordinate of a corner of the square, averaged over the four.
// Unknown are what an honest estimator cannot know: the four sides' offsets and angles, both
// levels, how the lighting falls off across the square, and the blur. It sees the pixels within
// five blurs of a side, at least 4 px, but no nearer to the next pattern than a quarter of a cell;
// right up to the corners, where only blur mixes the sides.
[[nodiscard]] double CornerBound(const SquareImage& image);

}  // namespace bladecurve
