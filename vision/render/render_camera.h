// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vision/render/render.h"

namespace bladecurve::render {

// The synthetic camera. Invariant: built from a valid spec, the world's origin is in front of it;
// never changes.
class Camera {
 public:
  Camera(const CameraSpec& spec, int width, int height);

  [[nodiscard]] Eigen::Vector2d PixelFromWorld(const Eigen::Vector3d& world_mm) const;
  // Where the pixel's ray meets the plane z = height_mm of the world.
  [[nodiscard]] Eigen::Vector2d WorldFromPixel(const Eigen::Vector2d& px, double height_mm) const;
  [[nodiscard]] const CameraTruth& truth() const { return truth_; }

 private:
  CameraTruth truth_;
  Eigen::Vector3d center_mm_;  // the pinhole in the world
};

}  // namespace bladecurve::render
