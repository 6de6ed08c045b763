// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/render/render.h"
#include "vision/render/render_camera.h"
#include "vision/render/render_outline.h"

namespace bladecurve::render {

// physics.md's frame, at the height of the cutting edges, to pixels.
[[nodiscard]] Eigen::Vector2d PixelFromScissors(const SceneSpec& scene,
                                                const Camera& camera,
                                                const Eigen::Vector2d& scissors_mm);

[[nodiscard]] SceneTruth MakeTruth(const SceneSpec& scene, const Camera& camera);

}  // namespace bladecurve::render
