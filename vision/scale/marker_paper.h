// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "vision/scale/scale.h"

namespace bladecurve {

// As far as a marker's white paper is taken to reach: what lies there is left out of the scene.
// Convex; stored pixels.
[[nodiscard]] std::array<Eigen::Vector2d, 4> PaperOf(const SeenMarker& marker);

}  // namespace bladecurve
