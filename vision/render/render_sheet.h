// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/render/render_camera.h"
#include "vision/render/render_coverage.h"
#include "vision/render/render_field.h"
#include "vision/render/synthetic_scene.h"

namespace bladecurve::render {

// What lies under the scissors: its colour, its texture, the light that falls on it, and the
// shadows. Linear light. Invariant: shadow maps and folds were computed when it was built.
class Sheet {
 public:
  // `shadow_casters`: outlines of the metal, mm in the world, at the height of the edges.
  Sheet(const SceneSpec& scene, const Camera& camera, const std::vector<Polygon>& shadow_casters);

  // The backdrop as it is seen at a pixel, RGB.
  [[nodiscard]] Eigen::Vector3d ColourAt(const Eigen::Vector2d& px) const;
  // The light that falls there, 1 = white paper is at full scale; for things printed on paper.
  [[nodiscard]] double LightAt(const Eigen::Vector2d& px) const;

 private:
  [[nodiscard]] CoarseField MakeShadow(const std::vector<Polygon>& casters,
                                       const Eigen::Vector2d& offset_mm,
                                       double blur_mm) const;
  [[nodiscard]] CoarseField MakeFolds() const;
  [[nodiscard]] Eigen::Vector3d AlbedoAt(const Eigen::Vector2d& world_mm) const;

  const SceneSpec& scene_;
  const Camera& camera_;
  Eigen::Vector2d towards_light_;  // in the sheet's plane, of length 1
  CoarseField cast_shadow_, contact_shadow_, folds_;
};

}  // namespace bladecurve::render
