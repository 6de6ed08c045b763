// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vision/located_blade.h"
#include "vision/plane_map.h"

namespace bladecurve {

// The line about which the blades turn into each other, in the plane of the edges.
struct MirrorLine {
  const PlaneMap& map;
  Eigen::Vector2d pivot, direction;

  [[nodiscard]] Eigen::Vector2d Across() const { return {-direction.y(), direction.x()}; }
  // The image of a point of the plane, from the pivot on along the line and aside of it.
  [[nodiscard]] Eigen::Vector2d At(double along, double aside) const;
  [[nodiscard]] Eigen::Vector2d Reflected(const Eigen::Vector2d& image_px) const;
};

// Through the pivot, halfway between the edges' directions: an edge that lies aside of its place
// runs much as it should.
[[nodiscard]] MirrorLine LineBetween(const PlaneMap& map,
                                     const Eigen::Vector2d& pivot_px,
                                     const Blades& blades);

}  // namespace bladecurve
