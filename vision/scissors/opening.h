// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/pivot/pivot.h"
#include "vision/scale/known_camera.h"
#include "vision/scale/plane_map.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// Opening angle between the rays from the pivot to the distal ends, its uncertainty, and the
// direction halfway, in the plane of the edges.
struct Opening {
  double theta_rad = 0, sigma_rad = 0;
  double view_sigma_rad = 0;  // more of it: what a slant of the camera that nobody knows does
  Eigen::Vector2d x_in_plane{0, 0};
};

// unknown_view: the camera, where no markers say how it stands; of a scan none.
[[nodiscard]] Opening MeasureOpening(const PlaneMap& map,
                                     const std::optional<CameraKnowledge>& unknown_view,
                                     const Pivot& pivot,
                                     const LocatedBlade& upper,
                                     const LocatedBlade& lower);

}  // namespace bladecurve
