// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "vision/render_camera.h"
#include "vision/render_coverage.h"
#include "vision/render_markers.h"
#include "vision/render_metal.h"
#include "vision/render_outline.h"
#include "vision/render_sensor.h"
#include "vision/render_sheet.h"
#include "vision/render_truth.h"

namespace bladecurve {
namespace {

using render::BladeOutline;
using render::Camera;
using render::CoverageGrid;
using render::Metal;
using render::PixelKernel;
using render::Polygon;
using render::Ring;
using render::Sheet;

using Colour = std::function<Eigen::Vector3d(const Eigen::Vector2d& px)>;

// A thing of one colour function inside one outline, both in pixels.
struct Layer {
  Polygon polygon;
  Colour colour;
  cv::Rect2d bounds;
};

constexpr int kTile =
    32;  // pixels; small enough that few tiles hold an edge, large enough to amortise their halo

void Require(bool holds, const std::string& field, double value, const std::string& bound) {
  if (holds) return;
  throw std::invalid_argument("RenderScene: " + field + " = " + std::to_string(value) +
                              " must be " + bound);
}

void Validate(const SceneSpec& scene) {
  Require(scene.width >= 1, "width", scene.width, "at least 1");
  Require(scene.height >= 1, "height", scene.height, "at least 1");
  Require(scene.camera.mm_per_px > 0, "camera.mm_per_px", scene.camera.mm_per_px, "positive");
  Require(scene.camera.distance_mm > scene.edge_height_mm,
          "camera.distance_mm",
          scene.camera.distance_mm,
          "above the scissors");
  Require(
      std::abs(scene.camera.tilt_rad) < 1.2, "camera.tilt_rad", scene.camera.tilt_rad, "below 1.2");
  Require(scene.camera.blur_px >= 0, "camera.blur_px", scene.camera.blur_px, "at least 0");
  const ScissorsSpec& s = scene.scissors;
  Require(s.length_mm > s.heel_mm, "scissors.length_mm", s.length_mm, "above heel_mm");
  Require(s.tip_radius_mm > 0, "scissors.tip_radius_mm", s.tip_radius_mm, "positive");
  Require(s.shank_length_mm > s.width_mm,
          "scissors.shank_length_mm",
          s.shank_length_mm,
          "above width_mm");
  Require(scene.sensor.gamma > 0, "sensor.gamma", scene.sensor.gamma, "positive");
}

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

// Invariant: all that is in the picture, from the sheet upwards; the layers refer to the other
// members, so it never moves.
class Stage {
 public:
  explicit Stage(const SceneSpec& scene)
      : scene_(scene),
        camera_(scene.camera, scene.width, scene.height),
        upper_(render::MakeBladeOutline(scene.scissors, true)),
        lower_(render::MakeBladeOutline(scene.scissors, false)),
        sheet_(scene, camera_, ShadowCasters()),
        upper_metal_(scene, upper_, true, scene.scissors.upper_on_top),
        lower_metal_(scene, lower_, false, !scene.scissors.upper_on_top) {
    for (const MarkerSpec& marker : scene.markers) AddMarker(marker);
    if (!scene.with_scissors) return;
    AddBlade(!scene.scissors.upper_on_top);
    AddBlade(scene.scissors.upper_on_top);
    if (scene.scissors.screw_visible) AddScrew();
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
  [[nodiscard]] const Sheet& sheet() const { return sheet_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  [[nodiscard]] Eigen::Vector2d WorldFromBlade(const Eigen::Vector2d& p, bool upper) const {
    return render::WorldFromScissors(render::ScissorsFromBlade(p, upper, scene_.theta_rad), scene_);
  }

  [[nodiscard]] Eigen::Vector2d BladeFromPixel(const Eigen::Vector2d& px,
                                               bool upper,
                                               double height_mm) const {
    const Eigen::Vector2d world_mm = camera_.WorldFromPixel(px, height_mm);
    return render::BladeFromScissors(
        render::ScissorsFromWorld(world_mm, scene_), upper, scene_.theta_rad);
  }

  [[nodiscard]] std::vector<Polygon> ShadowCasters() const {
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

  [[nodiscard]] Polygon Project(Polygon blade_mm, bool upper, double height_mm) const {
    for (Ring& ring : blade_mm) {
      for (Eigen::Vector2d& p : ring) {
        const Eigen::Vector2d world_mm = WorldFromBlade(p, upper);
        p = camera_.PixelFromWorld({world_mm.x(), world_mm.y(), height_mm});
      }
    }
    return blade_mm;
  }

  void AddMarker(const MarkerSpec& marker) {
    constexpr double kPaperAlbedo = 0.95, kInkAlbedo = 0.045;  // laser printer
    const auto printed = [this](double albedo) {
      return [this, albedo](const Eigen::Vector2d& px) {
        return Eigen::Vector3d(Eigen::Vector3d::Constant(albedo * sheet_.LightAt(px)));
      };
    };
    render::MarkerPolygons polygons = render::ProjectMarker(marker, camera_);
    layers_.push_back(MakeLayer(std::move(polygons.paper), printed(kPaperAlbedo)));
    layers_.push_back(MakeLayer(std::move(polygons.black), printed(kInkAlbedo)));
    if (!polygons.white.empty()) {
      layers_.push_back(MakeLayer(std::move(polygons.white), printed(kPaperAlbedo)));
    }
  }

  void AddBlade(bool upper) {
    const BladeOutline& outline = upper ? upper_ : lower_;
    const Metal& metal = upper ? upper_metal_ : lower_metal_;
    const double height_mm = scene_.edge_height_mm;
    layers_.push_back(MakeLayer(Project({outline.body}, upper, height_mm),
                                [=, this, &metal](const Eigen::Vector2d& px) {
                                  return metal.BodyAt(BladeFromPixel(px, upper, height_mm));
                                }));
    layers_.push_back(MakeLayer(Project({outline.ring_outer, outline.ring_inner}, upper, height_mm),
                                [=, this, &metal](const Eigen::Vector2d& px) {
                                  return metal.RingAt(BladeFromPixel(px, upper, height_mm));
                                }));
  }

  void AddScrew() {
    const bool upper = scene_.scissors.upper_on_top;
    const Metal& metal = upper ? upper_metal_ : lower_metal_;
    const double radius = scene_.scissors.screw_radius_mm;
    const double height_mm = scene_.edge_height_mm + scene_.scissors.thickness_mm;
    layers_.push_back(MakeLayer(Project({render::ScrewRim(radius)}, upper, height_mm),
                                [=, this, &metal](const Eigen::Vector2d& px) {
                                  return metal.ScrewAt(BladeFromPixel(px, upper, height_mm));
                                }));
    layers_.push_back(
        MakeLayer(Project({render::ScrewSlot(radius, scene_.scissors.slot_rad)}, upper, height_mm),
                  [=, this, &metal](const Eigen::Vector2d& px) {
                    constexpr double kSlotDepthShade = 0.18;  // little light reaches its bottom
                    return Eigen::Vector3d(kSlotDepthShade *
                                           metal.ScrewAt(BladeFromPixel(px, upper, height_mm)));
                  }));
  }

  const SceneSpec& scene_;
  Camera camera_;
  BladeOutline upper_, lower_;
  Sheet sheet_;
  Metal upper_metal_, lower_metal_;
  std::vector<Layer> layers_;
};

bool Touches(const Layer& layer, const cv::Rect2d& area) {
  return (layer.bounds & area).area() > 0;
}

// Whether the outline passes through the area, by the boxes of its segments: never misses one.
bool HasEdgeIn(const Layer& layer, const cv::Rect2d& area) {
  const double right = area.x + area.width, bottom = area.y + area.height;
  for (const Ring& ring : layer.polygon) {
    Eigen::Vector2d a = ring.back();
    for (const Eigen::Vector2d& b : ring) {
      if (std::max(a.x(), b.x()) >= area.x && std::min(a.x(), b.x()) <= right &&
          std::max(a.y(), b.y()) >= area.y && std::min(a.y(), b.y()) <= bottom) {
        return true;
      }
      a = b;
    }
  }
  return false;
}

void AddWeighted(const cv::Mat1f& weights,
                 const Colour& colour,
                 const cv::Rect& tile,
                 cv::Mat3f* picture) {
  constexpr float kNothing = 1e-6f;
  for (int r = 0; r < tile.height; ++r) {
    for (int c = 0; c < tile.width; ++c) {
      const float weight = weights(r, c);
      if (weight < kNothing) continue;
      const Eigen::Vector3d light = colour(Eigen::Vector2d(tile.x + c, tile.y + r));
      cv::Vec3f& pixel = (*picture)(tile.y + r, tile.x + c);
      for (int i = 0; i < 3; ++i) pixel[i] += weight * static_cast<float>(light[i]);
    }
  }
}

// Every layer's visible share of every pixel, lens and pixel box included, times its colour there.
// Surfaces are smooth over a pixel; their borders are not, so the borders are what is integrated.
void RenderTile(const Stage& stage,
                const PixelKernel& edge_kernel,
                const cv::Rect& tile,
                cv::Mat3f* picture) {
  const int halo = edge_kernel.halo_px;
  const cv::Rect2d area(
      tile.x - 0.5 - halo, tile.y - 0.5 - halo, tile.width + 2 * halo, tile.height + 2 * halo);
  std::vector<const Layer*> present;
  bool has_edge = false;
  for (const Layer& layer : stage.layers()) {
    if (!Touches(layer, area)) continue;
    present.push_back(&layer);
    has_edge = has_edge || HasEdgeIn(layer, area);
  }
  static const PixelKernel kFlat{.oversampling = 1, .halo_px = 0, .weights = {1.0f}};
  const PixelKernel& kernel = has_edge ? edge_kernel : kFlat;
  const CoverageGrid grid{
      .origin_px = Eigen::Vector2d(tile.x - 0.5 - kernel.halo_px, tile.y - 0.5 - kernel.halo_px),
      .step_px = 1.0 / kernel.oversampling,
      .cols = (tile.width + 2 * kernel.halo_px) * kernel.oversampling,
      .rows = (tile.height + 2 * kernel.halo_px) * kernel.oversampling};
  cv::Mat1f uncovered = cv::Mat1f::ones(grid.rows, grid.cols);
  for (auto layer = present.rbegin(); layer != present.rend(); ++layer) {
    const cv::Mat1f coverage = render::PolygonCoverage((*layer)->polygon, grid);
    const cv::Mat1f visible = uncovered.mul(coverage);
    uncovered -= visible;
    AddWeighted(render::IntegratePixels(visible, kernel), (*layer)->colour, tile, picture);
  }
  AddWeighted(
      render::IntegratePixels(uncovered, kernel),
      [&stage](const Eigen::Vector2d& px) { return stage.sheet().ColourAt(px); },
      tile,
      picture);
}

}  // namespace

RenderedPhoto RenderScene(const SceneSpec& spec) {
  Validate(spec);
  const Stage stage(spec);
  const PixelKernel kernel = render::MakePixelKernel(spec.camera.blur_px);
  cv::Mat3f linear = cv::Mat3f::zeros(spec.height, spec.width);
  for (int y = 0; y < spec.height; y += kTile) {
    for (int x = 0; x < spec.width; x += kTile) {
      const cv::Rect tile(x, y, std::min(kTile, spec.width - x), std::min(kTile, spec.height - y));
      RenderTile(stage, kernel, tile, &linear);
    }
  }
  return {render::Develop(linear, spec.sensor, spec.seed), render::MakeTruth(spec, stage.camera())};
}

SceneTruth TruthOf(const SceneSpec& spec) {
  Validate(spec);
  return render::MakeTruth(spec, Camera(spec.camera, spec.width, spec.height));
}

}  // namespace bladecurve
