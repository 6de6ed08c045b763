// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "vision/render/render_outline.h"
#include "vision/render/synthetic_scene.h"

namespace bladecurve::render {

// Brushed metal under a ceiling and a lamp: linear RGB of a point, given in the blade's frame. It
// says the colour of the surface only; where the metal ends is the outline's matter. All are
// defined beyond the outline too.
class Metal {
 public:
  // `on_top`: this blade shows its outer, bevelled side; else its flat inner side.
  Metal(const SceneSpec& scene, const BladeOutline& outline, bool upper, bool on_top);

  [[nodiscard]] Eigen::Vector3d BodyAt(const Eigen::Vector2d& blade_mm) const;
  [[nodiscard]] Eigen::Vector3d RingAt(const Eigen::Vector2d& blade_mm) const;
  // The head of the screw, its centre at the origin; any radius up to the spec's.
  [[nodiscard]] Eigen::Vector3d ScrewAt(const Eigen::Vector2d& blade_mm) const;

 private:
  struct Surface {
    Eigen::Vector2d tilt;  // of the normal, along u and v; 0 faces the camera
    double brushing;       // relative change of brightness by the streaks
  };
  // Of grinding, -1 to 1 times the spec's brushing; coordinates in units of a streak.
  [[nodiscard]] double Streak(std::uint64_t pattern, double x, double y) const;
  [[nodiscard]] Surface BladeSurface(const Eigen::Vector2d& blade_mm) const;
  [[nodiscard]] Surface ShankSurface(const Eigen::Vector2d& blade_mm) const;
  [[nodiscard]] Eigen::Vector3d Reflect(const Surface& surface) const;

  const SceneSpec& scene_;
  const BladeOutline& outline_;
  bool upper_, on_top_;
  double turn_rad_;               // of the blade's u axis in the world
  Eigen::Vector3d towards_lamp_;  // in the world, of length 1
};

}  // namespace bladecurve::render
