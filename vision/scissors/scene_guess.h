// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/edge/edge.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// Where the scene saw parts of a blade, `left` of the two, and how far from there they may lie.
// Paths may be empty.

// The cutting edge.
[[nodiscard]] EdgeGuess CuttingEdgeOf(const Scene& scene, bool left);

// The outer side, but for its ends, which bend.
[[nodiscard]] EdgeGuess OuterSideOf(const Scene& scene, bool left);

// The side of the blade's shank that faces as its cutting edge does.
[[nodiscard]] EdgeGuess ShankSideOf(const Scene& scene, bool left);

// The cutting edge as scene finding traced it, for want of a better one: good to a pixel of the
// small picture, and marked as doubtful.
[[nodiscard]] LocatedEdge AsTraced(const Scene& scene, bool left);

[[nodiscard]] inline const SceneBlade& BladeOf(const Scene& scene, bool left) {
  return left ? scene.left : scene.right;
}

}  // namespace bladecurve
