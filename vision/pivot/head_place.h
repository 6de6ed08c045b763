// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/screw.h"
#include "vision/scale/scale.h"
#include "vision/scale/sheet_pose.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The rim of a head stands above the plane of the edges by the thickness of a blade and of the
// head: by how much, and its standard uncertainty.
inline constexpr double kHeadMm = 2.0, kHeadSigmaMm = 0.6;

// Where the axis that `screw` shows meets the plane of the edges; stored pixels.
[[nodiscard]] PlacePx FootBelow(const Screw& screw, const ScaleResult& scale, const Scene& scene);

}  // namespace bladecurve
