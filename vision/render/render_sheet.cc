// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/render/render_noise.h"

namespace bladecurve::render {
namespace {

// Weight of a periodic texture: none where its period is near the pixel, which would alias.
double Resolved(double period_mm, double mm_per_px) {
  return std::clamp(period_mm / mm_per_px / 2 - 1, 0.0, 1.0);  // from 2 px on, whole at 4 px
}

double Weave(const Eigen::Vector2d& p, double period_mm) {
  const double turn = 2 * std::numbers::pi / period_mm;
  return std::sin(turn * p.x()) * std::sin(turn * p.y());
}

Eigen::Vector3d Wood(std::uint64_t seed, const Eigen::Vector2d& p, double strength) {
  const double bend = 3 * SmoothNoise(seed, p.x() / 90, p.y() / 60);
  const double across = p.y() + bend;
  const double growth = FractalNoise(seed + 11, p.x() / 160, across / 5, 3);
  const double pores = std::max(0.0, SmoothNoise(seed + 23, p.x() / 14, across / 0.5) - 0.45);
  const double tone = 1 + strength * (0.28 * growth - 0.5 * pores);
  return Eigen::Vector3d(0.40, 0.22, 0.11) * std::max(tone, 0.15);
}

}  // namespace

Sheet::Sheet(const SceneSpec& scene,
             const Camera& camera,
             const std::vector<Polygon>& shadow_casters)
    : scene_(scene),
      camera_(camera),
      towards_light_(std::cos(scene.light.direction_rad), std::sin(scene.light.direction_rad)) {
  const LightSpec& light = scene.light;
  const double length_mm = scene.edge_height_mm / std::tan(light.elevation_rad);
  const Eigen::Vector2d offset_mm = -length_mm * towards_light_;
  if (light.shadow > 0) cast_shadow_ = MakeShadow(shadow_casters, offset_mm, light.shadow_blur_mm);
  if (light.contact_shadow > 0) {
    constexpr double kContactReach =
        1.2;  // in heights: the sky hidden by the metal fades that fast
    contact_shadow_ =
        MakeShadow(shadow_casters, Eigen::Vector2d::Zero(), kContactReach * scene.edge_height_mm);
  }
  if (scene.backdrop == Backdrop::kCloth || scene.backdrop == Backdrop::kDrape)
    folds_ = MakeFolds();
}

CoarseField Sheet::MakeShadow(const std::vector<Polygon>& casters,
                              const Eigen::Vector2d& offset_mm,
                              double blur_mm) const {
  std::vector<Polygon> shadows = casters;
  for (Polygon& shadow : shadows) {
    for (Ring& ring : shadow) {
      for (Eigen::Vector2d& point : ring) {
        const Eigen::Vector2d p = point + offset_mm;
        point = camera_.PixelFromWorld({p.x(), p.y(), 0});
      }
    }
  }
  return ShadowField(
      shadows, cv::Size(scene_.width, scene_.height), blur_mm / scene_.camera.mm_per_px);
}

CoarseField Sheet::MakeFolds() const {
  CoarseField field;
  field.step_px = 8;
  const int cols = static_cast<int>(scene_.width / field.step_px) + 2;
  const int rows = static_cast<int>(scene_.height / field.step_px) + 2;
  field.values.create(rows, cols);
  const auto height = [this](double x, double y) {
    constexpr double kFoldMm = 55;
    const double n = FractalNoise(scene_.seed + 101, x / kFoldMm, y / kFoldMm, 3);
    return 1 - std::abs(n);  // ridges where the noise changes sign
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const Eigen::Vector2d p = camera_.WorldFromPixel(
          Eigen::Vector2d(c + 0.5, r + 0.5) * field.step_px - Eigen::Vector2d(0.5, 0.5), 0);
      constexpr double kDeltaMm = 4;
      const Eigen::Vector2d q = p + kDeltaMm * towards_light_;
      const double slope = height(p.x(), p.y()) - height(q.x(), q.y());
      field.values(r, c) = static_cast<float>(0.9 * scene_.texture * slope);
    }
  }
  return field;
}

double Sheet::LightAt(const Eigen::Vector2d& px) const {
  const double x = px.x() / scene_.width - 0.5, y = 0.5 - px.y() / scene_.height;
  const double along = x * towards_light_.x() + y * towards_light_.y();
  const double open = 1 + scene_.light.falloff * along;
  const double shadow = (1 - scene_.light.shadow * cast_shadow_.At(px)) *
                        (1 - scene_.light.contact_shadow * contact_shadow_.At(px));
  return scene_.light.exposure * open * shadow;
}

Eigen::Vector3d Sheet::AlbedoAt(const Eigen::Vector2d& p) const {
  const double mm_per_px = scene_.camera.mm_per_px;
  constexpr double kFibreMm = 0.7, kThreadMm = 0.8, kDrapeThreadMm = 0.6;
  switch (scene_.backdrop) {
    case Backdrop::kCutOut:
      return Eigen::Vector3d::Constant(1.6);  // clipped by the editor
    case Backdrop::kPaper: {
      const double fibre = Resolved(kFibreMm, mm_per_px) *
                           SmoothNoise(scene_.seed, p.x() / kFibreMm, p.y() / kFibreMm);
      return Eigen::Vector3d(1.0, 0.99, 0.97) * (1 + 0.006 * scene_.texture * fibre);
    }
    case Backdrop::kCloth: {
      const double thread = Resolved(kThreadMm, mm_per_px) * Weave(p, kThreadMm);
      return Eigen::Vector3d(0.20, 0.205, 0.22) * (1 + 0.12 * scene_.texture * thread);
    }
    case Backdrop::kDrape: {
      const double thread = Resolved(kDrapeThreadMm, mm_per_px) * Weave(p, kDrapeThreadMm);
      return scene_.drape_rgb * (1 + 0.15 * scene_.texture * thread);
    }
    case Backdrop::kWood:
      return Wood(scene_.seed, p, scene_.texture);
    case Backdrop::kBlack:
      return Eigen::Vector3d::Constant(0.018);
    case Backdrop::kLightTable:
      return Eigen::Vector3d::Constant(1.15);
  }
  return Eigen::Vector3d::Ones();
}

Eigen::Vector3d Sheet::ColourAt(const Eigen::Vector2d& px) const {
  const double light = LightAt(px) * std::max(0.1, 1 + folds_.At(px));
  return light * AlbedoAt(camera_.WorldFromPixel(px, 0));
}

}  // namespace bladecurve::render
