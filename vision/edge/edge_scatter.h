// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/edge/edge.h"
#include "vision/edge/edge_fit.h"

namespace bladecurve {

// Points of an edge from its slices, one each: their sigma enlarged to the
// scatter they show, outliers marked, the correlation of neighbours measured. Throws
// Refused{kBlurred}.
[[nodiscard]] LocatedEdge PointsFromFit(const EdgeFit& fit);

}  // namespace bladecurve
