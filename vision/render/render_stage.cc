// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_stage.h"

#include <cmath>
#include <utility>

#include "vision/render/render_markers.h"

namespace bladecurve::render {
namespace {

cv::Rect2d BoundsOf(const Polygon& polygon) {
  Eigen::Vector2d low = polygon.front().front(), high = low;
  for (const Ring& ring : polygon) {
    for (const Eigen::Vector2d& p : ring) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return {low.x(), low.y(), high.x() - low.x() + 1e-9, high.y() - low.y() + 1e-9};
}

Layer MakeLayer(Polygon polygon, Colour colour) {
  const cv::Rect2d bounds = BoundsOf(polygon);
  return {std::move(polygon), std::move(colour), bounds};
}

}  // namespace

Stage::Stage(const SceneSpec& scene)
    : scene_(scene),
      camera_(scene.camera, scene.width, scene.height),
      upper_(MakeBladeOutline(scene.scissors, true)),
      lower_(MakeBladeOutline(scene.scissors, false)),
      sheet_(scene, camera_, ShadowCasters()),
      upper_metal_(scene, upper_, true, scene.scissors.upper_on_top),
      lower_metal_(scene, lower_, false, !scene.scissors.upper_on_top) {
  if (scene.with_scissors) blade_shadow_ = ShadowOnLowerBlade();
  for (const MarkerSpec& marker : scene.markers) AddMarker(marker);
  if (!scene.with_scissors) return;
  AddBlade(!scene.scissors.upper_on_top);
  AddBlade(scene.scissors.upper_on_top);
  if (scene.scissors.screw_visible) AddScrew();
}

Eigen::Vector2d Stage::WorldFromBlade(const Eigen::Vector2d& blade_mm, bool upper) const {
  return WorldFromScissors(ScissorsFromBlade(blade_mm, upper, scene_.theta_rad), scene_);
}

Eigen::Vector2d Stage::BladeFromPixel(const Eigen::Vector2d& px,
                                      bool upper,
                                      double height_mm) const {
  const Eigen::Vector2d world_mm = camera_.WorldFromPixel(px, height_mm);
  return BladeFromScissors(ScissorsFromWorld(world_mm, scene_), upper, scene_.theta_rad);
}

std::vector<Polygon> Stage::ShadowCasters() const {
  if (!scene_.with_scissors) return {};
  std::vector<Polygon> casters;
  for (const bool is_upper : {true, false}) {
    const BladeOutline& outline = is_upper ? upper_ : lower_;
    casters.push_back({outline.body});
    casters.push_back({outline.ring_outer, outline.ring_inner});
    for (std::size_t i = casters.size() - 2; i < casters.size(); ++i) {
      for (Ring& ring : casters[i]) {
        for (Eigen::Vector2d& p : ring) p = WorldFromBlade(p, is_upper);
      }
    }
  }
  return casters;
}

Polygon Stage::Project(Polygon blade_mm, bool upper, double height_mm) const {
  for (Ring& ring : blade_mm) {
    for (Eigen::Vector2d& p : ring) {
      const Eigen::Vector2d world_mm = WorldFromBlade(p, upper);
      p = camera_.PixelFromWorld({world_mm.x(), world_mm.y(), height_mm});
    }
  }
  return blade_mm;
}

// The blade on top stands a thickness above the face of the other one; the light makes it fall away
// from the lamp, and the sky that it hides makes the joint dark.
CoarseField Stage::ShadowOnLowerBlade() const {
  const bool upper = scene_.scissors.upper_on_top;
  const LightSpec& light = scene_.light;
  const double reach_mm = scene_.scissors.thickness_mm / std::tan(light.elevation_rad);
  const Eigen::Vector2d offset_mm =
      -reach_mm * Eigen::Vector2d(std::cos(light.direction_rad), std::sin(light.direction_rad));
  Ring shadow = upper ? upper_.body : lower_.body;
  for (Eigen::Vector2d& p : shadow) {
    const Eigen::Vector2d world_mm = WorldFromBlade(p, upper) + offset_mm;
    p = camera_.PixelFromWorld({world_mm.x(), world_mm.y(), scene_.edge_height_mm});
  }
  const double blur_mm = 0.3 * scene_.scissors.thickness_mm + 0.2 * light.shadow_blur_mm;
  return ShadowField(
      {{shadow}}, cv::Size(scene_.width, scene_.height), blur_mm / scene_.camera.mm_per_px);
}

void Stage::AddMarker(const MarkerSpec& marker) {
  constexpr double kPaperAlbedo = 0.95, kInkAlbedo = 0.045;  // laser printer
  const auto printed = [this](double albedo) {
    return [this, albedo](const Eigen::Vector2d& px) {
      return Eigen::Vector3d(Eigen::Vector3d::Constant(albedo * sheet_.LightAt(px)));
    };
  };
  MarkerPolygons polygons = ProjectMarker(marker, camera_);
  layers_.push_back(MakeLayer(std::move(polygons.paper), printed(kPaperAlbedo)));
  layers_.push_back(MakeLayer(std::move(polygons.black), printed(kInkAlbedo)));
  if (!polygons.white.empty()) {
    layers_.push_back(MakeLayer(std::move(polygons.white), printed(kPaperAlbedo)));
  }
}

void Stage::AddBlade(bool upper) {
  const BladeOutline& outline = upper ? upper_ : lower_;
  const Metal& metal = upper ? upper_metal_ : lower_metal_;
  const double height_mm = scene_.edge_height_mm;
  const double shadow = upper == scene_.scissors.upper_on_top ? 0 : scene_.light.shadow;
  layers_.push_back(MakeLayer(
      Project({outline.body}, upper, height_mm), [=, this, &metal](const Eigen::Vector2d& px) {
        const double light = 1 - shadow * blade_shadow_.At(px);
        return Eigen::Vector3d(light * metal.BodyAt(BladeFromPixel(px, upper, height_mm)));
      }));
  layers_.push_back(MakeLayer(Project({outline.ring_outer, outline.ring_inner}, upper, height_mm),
                              [=, this, &metal](const Eigen::Vector2d& px) {
                                return metal.RingAt(BladeFromPixel(px, upper, height_mm));
                              }));
}

void Stage::AddScrew() {
  const bool upper = scene_.scissors.upper_on_top;
  const Metal& metal = upper ? upper_metal_ : lower_metal_;
  const double radius = scene_.scissors.screw_radius_mm;
  const double height_mm = scene_.edge_height_mm + scene_.scissors.screw_mm;
  layers_.push_back(MakeLayer(Project({ScrewRim(radius)}, upper, height_mm),
                              [=, this, &metal](const Eigen::Vector2d& px) {
                                return metal.ScrewAt(BladeFromPixel(px, upper, height_mm));
                              }));
  layers_.push_back(
      MakeLayer(Project({ScrewSlot(scene_.scissors)}, upper, height_mm),
                [=, this, &metal](const Eigen::Vector2d& px) {
                  constexpr double kSlotDepthShade = 0.18;  // little light reaches its bottom
                  return Eigen::Vector3d(kSlotDepthShade *
                                         metal.ScrewAt(BladeFromPixel(px, upper, height_mm)));
                }));
}

}  // namespace bladecurve::render
