// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vision/scene/scene.h"

namespace bladecurve {

// How far along the joint a place lies: 0 at the shanks' crotch, 1 at the blades'.
[[nodiscard]] inline double ShareOfJoint(const Scene& scene, const Eigen::Vector2d& place_px) {
  const Eigen::Vector2d joint = scene.crotch_px - scene.shank_crotch_px;
  return joint.dot(place_px - scene.shank_crotch_px) / joint.squaredNorm();
}

}  // namespace bladecurve
