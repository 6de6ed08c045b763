// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/scene/scene_candidate.h"

namespace bladecurve {

// Where the joint may end, px of the small picture, if the mask of a pair lost a part of it: metal
// as bright as its ground is missing from a mask, and the shanks' crotch is then where the hole
// begins. So it is where two members as wide as the blades that cross at their opening overlap by
// more than was found, or where a shank shows by its rim alone. std::nullopt where nothing was
// lost.
[[nodiscard]] std::optional<Eigen::Vector2d> EndOfLostJoint(const Candidate& found);

}  // namespace bladecurve
