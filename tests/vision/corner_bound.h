// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/square_images.h"

namespace bladecurve {

// Cramér-Rao bound, px, of one coordinate of a corner of the square, averaged over the four.
// Unknown are the four corners, both levels, how the lighting falls off across the square, and the
// blur. Borders that lie where they were printed count as known: what an estimator pays for not
// relying on that shows against this bound.
[[nodiscard]] double CornerBound(const SquareImage& image);

}  // namespace bladecurve
