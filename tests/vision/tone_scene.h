// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/edge_images.h"
#include "vision/image/tone_curve.h"
#include "vision/render/render.h"

namespace bladecurve::testing {

// As FindScale reads it off the default card, rendered under scissors.
[[nodiscard]] ToneCurve ToneByCard(const SensorSpec& sensor);

// How far LocateEdge finds a straight edge away from the blade, px.
[[nodiscard]] double OffsetOfEdge(const EdgeLook& look, const ToneCurve& tone);

}  // namespace bladecurve::testing
