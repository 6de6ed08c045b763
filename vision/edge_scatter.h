// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/edge.h"
#include "vision/edge_fit.h"

namespace bladecurve {

// Points of an edge from its slices: combined to the wanted spacing, their sigma enlarged to the
// scatter they show, outliers marked, the correlation of neighbours measured. Throws
// Refused{kEdgeTooShort, kBlurred}.
[[nodiscard]] LocatedEdge PointsFromFit(const EdgeFit& fit, const EdgeOptions& options);

// Standard uncertainty of the offset that a wrong tone curve gives all points alike.
[[nodiscard]] double ToneSigma(const EdgeFit& fit, const ToneCurve& tone);

}  // namespace bladecurve
