// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>

#include "vision/render/render_coverage.h"
#include "vision/render/render_sensor.h"
#include "vision/render/render_stage.h"
#include "vision/render/render_truth.h"

namespace bladecurve {
namespace {

using render::Colour;
using render::CoverageGrid;
using render::Layer;
using render::PixelKernel;
using render::Ring;
using render::Stage;

// Pixels: small enough that few tiles hold an edge, large enough to amortise their halo.
constexpr int kTile = 32;

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
  Require(s.shank_length_mm > s.joint_mm + s.width_mm,
          "scissors.shank_length_mm",
          s.shank_length_mm,
          "above joint_mm + width_mm");
  Require(s.joint_mm > 0, "scissors.joint_mm", s.joint_mm, "positive");
  Require(scene.sensor.gamma > 0, "sensor.gamma", scene.sensor.gamma, "positive");
}

// Shares of a pixel's light that are left out.
constexpr float kNothing = 1e-6f;

bool IsNothing(const cv::Mat1f& shares) {
  const float* first = shares[0];  // a tile's shares lie one behind the other
  return std::none_of(first, first + shares.total(), [](float s) { return s >= kNothing; });
}

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

bool Covers(const Layer& layer, const Eigen::Vector2d& px) {
  const CoverageGrid cell{.origin_px = px, .cols = 1, .rows = 1};
  return render::PolygonCoverage(layer.polygon, cell)(0, 0) > 0.5f;
}

// What of a stage a tile may show.
struct LayerInTile {
  const Layer* layer;
  bool has_edge;  // else it covers the whole tile
};

// Bottom first.
std::vector<LayerInTile> LayersIn(const Stage& stage, const cv::Rect2d& area) {
  const Eigen::Vector2d middle(area.x + 0.5 * area.width, area.y + 0.5 * area.height);
  std::vector<LayerInTile> present;
  for (const Layer& layer : stage.layers()) {
    if (!Touches(layer, area)) continue;
    const bool has_edge = HasEdgeIn(layer, area);
    if (!has_edge && !Covers(layer, middle)) continue;
    if (!has_edge) present.clear();  // nothing below it is seen
    present.push_back({&layer, has_edge});
  }
  return present;
}

void AddWeighted(const cv::Mat1f& weights,
                 const Colour& colour,
                 const cv::Rect& tile,
                 cv::Mat3f* picture) {
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
  const std::vector<LayerInTile> present = LayersIn(stage, area);
  const bool has_edge =
      std::any_of(present.begin(), present.end(), [](const LayerInTile& l) { return l.has_edge; });
  static const PixelKernel kFlat{.oversampling = 1, .halo_px = 0, .weights = {1.0f}};
  const PixelKernel& kernel = has_edge ? edge_kernel : kFlat;
  const CoverageGrid grid{
      .origin_px = Eigen::Vector2d(tile.x - 0.5 - kernel.halo_px, tile.y - 0.5 - kernel.halo_px),
      .step_px = 1.0 / kernel.oversampling,
      .cols = (tile.width + 2 * kernel.halo_px) * kernel.oversampling,
      .rows = (tile.height + 2 * kernel.halo_px) * kernel.oversampling};
  cv::Mat1f uncovered = cv::Mat1f::ones(grid.rows, grid.cols);
  for (auto seen = present.rbegin(); seen != present.rend(); ++seen) {
    const Layer& layer = *seen->layer;
    const cv::Mat1f visible =
        seen->has_edge ? cv::Mat1f(uncovered.mul(render::PolygonCoverage(layer.polygon, grid)))
                       : uncovered;
    if (!IsNothing(visible))
      AddWeighted(render::IntegratePixels(visible, kernel), layer.colour, tile, picture);
    if (!seen->has_edge) return;
    uncovered -= visible;
  }
  if (IsNothing(uncovered)) return;
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
  return render::MakeTruth(spec, render::Camera(spec.camera, spec.width, spec.height));
}

}  // namespace bladecurve
