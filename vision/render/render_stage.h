// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/render/render_camera.h"
#include "vision/render/render_coverage.h"
#include "vision/render/render_field.h"
#include "vision/render/render_metal.h"
#include "vision/render/render_outline.h"
#include "vision/render/render_sheet.h"

namespace bladecurve::render {

using Colour = std::function<Eigen::Vector3d(const Eigen::Vector2d& px)>;  // linear RGB

// A thing of one colour function inside one outline, both in pixels.
struct Layer {
  Polygon polygon;
  Colour colour;
  cv::Rect2d bounds;
};

// Invariant: all that is in the picture, from the sheet upwards; the layers refer to the other
// members, so it never moves.
class Stage {
 public:
  explicit Stage(const SceneSpec& scene);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }  // bottom first
  [[nodiscard]] const Sheet& sheet() const { return sheet_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  [[nodiscard]] Eigen::Vector2d WorldFromBlade(const Eigen::Vector2d& blade_mm, bool upper) const;
  [[nodiscard]] Eigen::Vector2d BladeFromPixel(const Eigen::Vector2d& px,
                                               bool upper,
                                               double height_mm) const;
  [[nodiscard]] Polygon Project(Polygon blade_mm, bool upper, double height_mm) const;
  [[nodiscard]] std::vector<Polygon> ShadowCasters() const;
  [[nodiscard]] CoarseField ShadowOnLowerBlade() const;
  void AddMarker(const MarkerSpec& marker);
  void AddBlade(bool upper);
  void AddScrew();

  const SceneSpec& scene_;
  Camera camera_;
  BladeOutline upper_, lower_;
  Sheet sheet_;
  Metal upper_metal_, lower_metal_;
  CoarseField blade_shadow_;  // that the blade on top casts on the other one
  std::vector<Layer> layers_;
};

}  // namespace bladecurve::render
