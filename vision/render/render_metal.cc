// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_metal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vision/render/render_noise.h"

namespace bladecurve::render {
namespace {

Eigen::Vector3d Tint(Finish finish) {
  switch (finish) {
    case Finish::kSteel:
      return {0.93, 0.96, 1.0};
    case Finish::kGold:
      return {1.0, 0.80, 0.42};
    case Finish::kBlack:
      return {0.10, 0.10, 0.11};
  }
  return Eigen::Vector3d::Ones();
}

double SmoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Metal::Metal(const SceneSpec& scene, const BladeOutline& outline, bool upper, bool on_top)
    : scene_(scene),
      outline_(outline),
      upper_(upper),
      on_top_(on_top),
      turn_rad_(scene.heading_rad + (upper ? 0.5 : -0.5) * scene.theta_rad),
      towards_lamp_(std::cos(scene.light.direction_rad) * std::cos(scene.light.elevation_rad),
                    std::sin(scene.light.direction_rad) * std::cos(scene.light.elevation_rad),
                    std::sin(scene.light.elevation_rad)) {}

// What a mirror of that tilt shows: a ceiling, darker towards its border, the sheet below the
// horizon, and a lamp.
Eigen::Vector3d Metal::Reflect(const Surface& surface) const {
  const Eigen::Vector2d upright(surface.tilt.x(), upper_ ? surface.tilt.y() : -surface.tilt.y());
  const Eigen::Vector2d tilt = Eigen::Rotation2Dd(turn_rad_) * upright;
  const Eigen::Vector3d normal = Eigen::Vector3d(tilt.x(), tilt.y(), 1).normalized();
  const Eigen::Vector3d seen = 2 * normal.z() * normal - Eigen::Vector3d::UnitZ();
  const LightSpec& light = scene_.light;
  constexpr double kLampFocus = 14;  // a lamp some 20 degrees wide, as brushed metal spreads it
  const double ceiling = 0.16 + 0.26 * SmoothStep(-0.2, 1.0, seen.z());
  const double below = 0.18 * (1 - SmoothStep(-0.3, 0.1, seen.z()));
  const double highlight = light.glint * 1.3 * std::exp(kLampFocus * (seen.dot(towards_lamp_) - 1));
  const double backlit =
      scene_.backdrop == Backdrop::kLightTable ? 0.12 : 1;  // light from below only
  return Tint(scene_.finish) *
         (light.exposure * backlit * (ceiling + below + highlight) * (1 + surface.brushing));
}

double Metal::Streak(std::uint64_t pattern, double x, double y) const {
  return scene_.scissors.brushing * SmoothNoise(scene_.seed + pattern, x, y);
}

Metal::Surface Metal::BladeSurface(const Eigen::Vector2d& p) const {
  const ScissorsSpec& spec = scene_.scissors;
  const double from_edge = p.y() - outline_.edge.At(p.x());
  const double along = std::clamp(p.x() / spec.length_mm, 0.0, 1.0);
  const double width = outline_.back_mm - outline_.edge.At(0) +
                       along * (2 * spec.tip_radius_mm - outline_.back_mm + outline_.edge.At(0));
  const double across = std::clamp(2 * from_edge / width - 1, -1.0, 1.0);
  // Ground across the blade: streaks along v, long in v and fine in u.
  const double streak = Streak(upper_ ? 31 : 37, p.x() / 0.35, p.y() / 7);
  constexpr double kInnerFlat = 0.03, kOuterRound = 0.22, kBevelTilt = 0.34;
  if (!on_top_) return {{0.02 * streak, kInnerFlat * across}, 0.10 * streak};
  const double bevel = spec.bevel_mm > 0 && p.x() > 0
                           ? 1 - SmoothStep(0.8 * spec.bevel_mm, spec.bevel_mm, from_edge)
                           : 0;
  return {
      {0.02 * streak, kOuterRound * across * std::abs(across) * (1 - bevel) - kBevelTilt * bevel},
      0.07 * streak};
}

Metal::Surface Metal::ShankSurface(const Eigen::Vector2d& p) const {
  const ShankPath& path = outline_.shank_path;
  const double t = std::clamp((path[0].x() - p.x()) / (path[0].x() - path[3].x()), 0.0, 1.0);
  const double across =
      std::clamp((p.y() - BezierPoint(path, t).y()) / outline_.shank_half_mm, -1.2, 1.2);
  const double streak = Streak(upper_ ? 41 : 43, p.x() / 9, p.y() / 0.3);
  constexpr double kRoundness = 0.75;  // flat on top, steep at its sides
  return {{0, kRoundness * across * across * across + 0.02 * streak}, 0.05 * streak};
}

Eigen::Vector3d Metal::BodyAt(const Eigen::Vector2d& p) const {
  const double shank_from = outline_.shank_path[0].x();
  const double joint = SmoothStep(shank_from, shank_from + 0.2 * scene_.scissors.width_mm, p.x());
  if (joint >= 1) return Reflect(BladeSurface(p));
  if (joint <= 0) return Reflect(ShankSurface(p));
  return joint * Reflect(BladeSurface(p)) + (1 - joint) * Reflect(ShankSurface(p));
}

Eigen::Vector3d Metal::RingAt(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d from_center = p - outline_.ring_center_mm;
  const Eigen::Vector2d scaled = from_center.cwiseQuotient(outline_.ring_middle_mm);
  const double radius = std::max(scaled.norm(), 1e-6);
  const double mean_mm = outline_.ring_middle_mm.mean();
  const double across = std::clamp((radius - 1) * mean_mm / outline_.tube_half_mm, -1.0, 1.0);
  const double streak = Streak(47, p.x() / 2, p.y() / 2);
  constexpr double kRoundness = 0.9;
  return Reflect({kRoundness * across * std::abs(across) * scaled / radius, 0.03 * streak});
}

Eigen::Vector3d Metal::ScrewAt(const Eigen::Vector2d& p) const {
  const double radius = p.norm() / scene_.scissors.screw_radius_mm;
  const Eigen::Vector2d outwards = p / std::max(p.norm(), 1e-6);
  const double rounding = 0.45 * SmoothStep(0.72, 1.0, radius);  // turned rim
  const double rings = SmoothNoise(scene_.seed + 53, radius * 9, 0);
  constexpr double kDarkerThanBlade = 0.72;
  return kDarkerThanBlade * Reflect({rounding * outwards, 0.05 * rings});
}

}  // namespace bladecurve::render
