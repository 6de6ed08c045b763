// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_truth.h"

#include <cmath>

#include "vision/render/render_markers.h"

namespace bladecurve {
namespace render {
namespace {

constexpr int kEdgeSamples = 401;

// Crossing number.
bool Inside(const Ring& ring, const Eigen::Vector2d& p) {
  bool inside = false;
  Eigen::Vector2d a = ring.back();
  for (const Eigen::Vector2d& b : ring) {
    const bool crosses = (a.y() > p.y()) != (b.y() > p.y());
    if (crosses && p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) {
      inside = !inside;
    }
    a = b;
  }
  return inside;
}

// u of the crotch: walking from the distal end towards the pivot, where the edge first meets the
// other blade.
double CrotchOf(const SceneSpec& scene, const EdgeShape& edge, bool upper) {
  const BladeOutline other = MakeBladeOutline(scene.scissors, !upper);
  const auto is_free = [&](double u) {
    const Eigen::Vector2d p = ScissorsFromBlade({u, edge.At(u)}, upper, scene.theta_rad);
    return !Inside(other.body, BladeFromScissors(p, !upper, scene.theta_rad));
  };
  constexpr double kStrideMm = 0.25, kToleranceMm = 1e-6;
  double free_u = edge.to_mm;
  if (!is_free(free_u)) return edge.to_mm;
  while (free_u > edge.from_mm && is_free(free_u - kStrideMm)) free_u -= kStrideMm;
  if (free_u <= edge.from_mm) return edge.from_mm;
  double covered_u = free_u - kStrideMm;
  while (free_u - covered_u > kToleranceMm) {
    const double middle = 0.5 * (free_u + covered_u);
    (is_free(middle) ? free_u : covered_u) = middle;
  }
  return std::max(free_u, edge.from_mm);
}

EdgeTruth MakeEdgeTruth(const SceneSpec& scene, const Camera& camera, bool upper) {
  EdgeTruth truth;
  truth.shape = EdgeShapeOf(scene.scissors, upper);
  for (int i = 0; i < kEdgeSamples; ++i) {
    const double u =
        truth.shape.from_mm + (truth.shape.to_mm - truth.shape.from_mm) * i / (kEdgeSamples - 1);
    truth.blade_mm.push_back({u, truth.shape.At(u)});
    truth.scissors_mm.push_back(ScissorsFromBlade(truth.blade_mm.back(), upper, scene.theta_rad));
    truth.px.push_back(PixelFromScissors(scene, camera, truth.scissors_mm.back()));
  }
  truth.end_px = truth.px.back();
  truth.free_from_mm = CrotchOf(scene, truth.shape, upper);
  return truth;
}

bool InFrame(const SceneSpec& scene, const Eigen::Vector2d& px) {
  return px.x() > 0 && px.y() > 0 && px.x() < scene.width - 1 && px.y() < scene.height - 1;
}

}  // namespace

Eigen::Vector2d PixelFromScissors(const SceneSpec& scene,
                                  const Camera& camera,
                                  const Eigen::Vector2d& scissors_mm) {
  const Eigen::Vector2d world_mm = WorldFromScissors(scissors_mm, scene);
  return camera.PixelFromWorld({world_mm.x(), world_mm.y(), scene.edge_height_mm});
}

SceneTruth MakeTruth(const SceneSpec& scene, const Camera& camera) {
  constexpr double kDeltaMm = 1e-3;  // of the central difference along the axis; its error is 1e-10
  SceneTruth truth;
  truth.width = scene.width;
  truth.height = scene.height;
  truth.theta_rad = scene.theta_rad;
  truth.edge_height_mm = scene.edge_height_mm;
  truth.camera = camera.truth();
  truth.pivot_px = PixelFromScissors(scene, camera, {0, 0});
  const double screw_mm = scene.edge_height_mm + scene.scissors.screw_mm;
  truth.screw_px = camera.PixelFromWorld({scene.pivot_mm.x(), scene.pivot_mm.y(), screw_mm});
  const Eigen::Vector2d px_per_mm = (PixelFromScissors(scene, camera, {kDeltaMm, 0}) -
                                     PixelFromScissors(scene, camera, {-kDeltaMm, 0})) /
                                    (2 * kDeltaMm);
  truth.axis_px = px_per_mm.normalized();
  truth.mm_per_px = 1 / px_per_mm.norm();
  truth.upper = MakeEdgeTruth(scene, camera, true);
  truth.lower = MakeEdgeTruth(scene, camera, false);
  truth.tips_in_frame = InFrame(scene, truth.upper.end_px) && InFrame(scene, truth.lower.end_px);
  for (const MarkerSpec& marker : scene.markers) {
    truth.markers.push_back(MarkerTruthOf(marker, camera));
  }
  return truth;
}

}  // namespace render
}  // namespace bladecurve
