// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/edge/edge_choice.h"
#include "vision/edge/edge_fit.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// Standard uncertainty, px, of an offset that all points of an edge share and no amount of pixels
// reduces: a tone curve that is not known, overexposure, another transition that might be the
// border.
[[nodiscard]] double CommonSigma(const EdgeFit& fit,
                                 const ToneCurve& tone,
                                 const ChosenTransition& chosen,
                                 bool blur_known);

// The part of that which another transition makes: nothing for a rival that is much worse; for one
// that is as good, most of the way to it: over rendered scenes the rival is then the border almost
// every other time.
[[nodiscard]] double RivalSigma(const ChosenTransition& chosen);

// Light that slopes beside the edge is continued to it as a straight line, or a parabola: a third
// of what it changes within reach may be wrong, and moves the half-way level.
[[nodiscard]] double SlopeSigma(const EdgeFit& fit);

}  // namespace bladecurve
