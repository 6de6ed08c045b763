// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_paper.h"

namespace bladecurve {

using Eigen::Vector2d;

std::array<Vector2d, 4> PaperOf(const SeenMarker& marker) {
  constexpr double kSides = 1.6;  // of the marker
  Vector2d center = Vector2d::Zero();
  for (const Vector2d& corner : marker.corners_px) center += 0.25 * corner;
  std::array<Vector2d, 4> paper = marker.corners_px;
  for (Vector2d& corner : paper) corner = center + kSides * (corner - center);
  return paper;
}

}  // namespace bladecurve
