// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bladecurve {

double EdgeShape::At(double u_mm) const {
  if (u_mm > to_mm) return bernstein_mm[3] + SlopeAt(to_mm) * (u_mm - to_mm);
  if (u_mm < from_mm) return bernstein_mm[0] + SlopeAt(from_mm) * (u_mm - from_mm);
  const double t = (u_mm - from_mm) / (to_mm - from_mm), r = 1 - t;
  return bernstein_mm[0] * r * r * r + 3 * bernstein_mm[1] * r * r * t +
         3 * bernstein_mm[2] * r * t * t + bernstein_mm[3] * t * t * t;
}

double EdgeShape::SlopeAt(double u_mm) const {
  const double t = std::clamp((u_mm - from_mm) / (to_mm - from_mm), 0.0, 1.0), r = 1 - t;
  const auto& c = bernstein_mm;
  return 3 / (to_mm - from_mm) *
         ((c[1] - c[0]) * r * r + 2 * (c[2] - c[1]) * r * t + (c[3] - c[2]) * t * t);
}

namespace render {
namespace {

using Bezier = std::array<Eigen::Vector2d, 4>;

constexpr double kStepMm = 0.2;       // sagitta of an arc of R = 30 mm: 1.7e-4 mm
constexpr double kArcStepRad = 0.03;  // sagitta R 1.1e-4
constexpr int kBezierPieces = 60;

// Appends the curve without its first point.
void AppendBezier(Ring* ring, const Bezier& control) {
  for (int i = 1; i <= kBezierPieces; ++i) {
    ring->push_back(BezierPoint(control, static_cast<double>(i) / kBezierPieces));
  }
}

// From the ring's last point to `end`, leaving and arriving in the given directions.
void AppendSmooth(Ring* ring,
                  const Eigen::Vector2d& leaving,
                  const Eigen::Vector2d& end,
                  const Eigen::Vector2d& arriving) {
  const Eigen::Vector2d start = ring->back();
  const double reach = (end - start).norm() * 0.36;  // close to uniform speed along the curve
  AppendBezier(ring, {start, start + reach * leaving, end - reach * arriving, end});
}

void AppendEdge(Ring* ring, const EdgeShape& edge) {
  const int pieces = static_cast<int>(std::ceil((edge.to_mm - edge.from_mm) / kStepMm));
  for (int i = 0; i <= pieces; ++i) {
    const double u = edge.from_mm + (edge.to_mm - edge.from_mm) * i / pieces;
    ring->push_back({u, edge.At(u)});
  }
}

Eigen::Vector2d Direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

// The rounded tip: from the distal end, tangent to the edge, round to where the back begins.
// Returns the direction in which it ends.
Eigen::Vector2d AppendTip(Ring* ring, const EdgeShape& edge, double radius, double back_mm) {
  const double edge_angle = std::atan(edge.SlopeAt(edge.to_mm));
  const Eigen::Vector2d center =
      Eigen::Vector2d(edge.to_mm, 0) + radius * Direction(edge_angle + std::numbers::pi / 2);
  const double back_angle = std::atan2(back_mm - center.y() - radius, -center.x());
  constexpr double kConvexBack = 0.09;  // the back leaves the tip this much steeper than its chord
  const double first = edge_angle - std::numbers::pi / 2;
  const double last = back_angle - kConvexBack - std::numbers::pi / 2;
  const int pieces = static_cast<int>(std::ceil((last - first) / kArcStepRad));
  for (int i = 1; i <= pieces; ++i) {
    ring->push_back(center + radius * Direction(first + (last - first) * i / pieces));
  }
  return Direction(last + std::numbers::pi / 2);
}

void AppendShank(Ring* ring, const ShankPath& path, double half, bool outwards) {
  constexpr double kFlareMm = 9;  // the shank widens towards its ring over this length
  const double length = (path[3] - path[0]).norm();
  for (int i = 0; i <= kBezierPieces; ++i) {
    const double t = static_cast<double>(outwards ? i : kBezierPieces - i) / kBezierPieces;
    constexpr double kDelta = 1e-4;
    const Eigen::Vector2d ahead =
        (BezierPoint(path, t + kDelta) - BezierPoint(path, t - kDelta)).normalized();
    const Eigen::Vector2d side(ahead.y(), -ahead.x());  // towards +v, as the shank runs to -u
    const double near_ring = std::max(0.0, 1 - (1 - t) * length / kFlareMm);
    const double width = half * (1 - 0.15 * t + 0.25 * near_ring * near_ring);
    ring->push_back(BezierPoint(path, t) + (outwards ? width : -width) * side);
  }
}

Ring Ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& semi_axes, bool clockwise) {
  const int pieces = static_cast<int>(std::ceil(2 * std::numbers::pi / kArcStepRad));
  Ring ring;
  for (int i = 0; i < pieces; ++i) {
    const double angle = (clockwise ? -2 : 2) * std::numbers::pi * i / pieces;
    ring.push_back(center + Direction(angle).cwiseProduct(semi_axes));
  }
  return ring;
}

// The midline starts behind the joint a little above the pivot and ends below the axis, so that
// closed rings lie side by side.
ShankPath ShankPathOf(const ScissorsSpec& spec) {
  const Eigen::Vector2d start(-spec.joint_mm - 0.3 * spec.width_mm, 0.10 * spec.width_mm);
  const Eigen::Vector2d end(-spec.shank_length_mm, -0.5 * spec.shank_mm - 1.0);
  const double reach = (start.x() - end.x()) / 3;
  return {
      start, start - Eigen::Vector2d(reach, 0.02 * reach), end + Eigen::Vector2d(reach, 0.0), end};
}

void PlaceRing(const ScissorsSpec& spec, BladeOutline* outline) {
  const double tube = 0.28 * spec.shank_mm + 0.5;  // half thickness: a little less than the shank's
  const Eigen::Vector2d inner(0.5 * spec.ring_mm, 0.41 * spec.ring_mm);
  const Eigen::Vector2d outer = inner + 2 * Eigen::Vector2d(tube, tube);
  const Eigen::Vector2d shank_end = outline->shank_path[3];
  outline->tube_half_mm = tube;
  outline->ring_middle_mm = inner + Eigen::Vector2d(tube, tube);
  // The shank ends inside the tube, on the side next to the other ring.
  constexpr double kJunctionRad = 0.75;
  outline->ring_center_mm =
      shank_end - Direction(kJunctionRad).cwiseProduct(outline->ring_middle_mm);
  outline->ring_outer = Ellipse(outline->ring_center_mm, outer, false);
  outline->ring_inner = Ellipse(outline->ring_center_mm, inner, true);
}

}  // namespace

Eigen::Vector2d BezierPoint(const std::array<Eigen::Vector2d, 4>& control, double t) {
  const double r = 1 - t;
  return r * r * r * control[0] + 3 * r * r * t * control[1] + 3 * r * t * t * control[2] +
         t * t * t * control[3];
}

EdgeShape EdgeShapeOf(const ScissorsSpec& spec, bool upper) {
  const double span = spec.length_mm - spec.heel_mm;
  const double bow = spec.bow_mm + (upper ? spec.curve_mm : -spec.curve_mm);
  // Straight part m (u - L); bow 4 t (1 - t) and skew 4 t (1 - t)(2 t - 1) have the middle
  // coefficients 4/3 and -+4/3.
  EdgeShape shape{.from_mm = spec.heel_mm, .to_mm = spec.length_mm, .bernstein_mm = {}};
  shape.bernstein_mm = {-spec.inclination * span,
                        -spec.inclination * span * 2 / 3 + (bow - spec.skew_mm) * 4 / 3,
                        -spec.inclination * span / 3 + (bow + spec.skew_mm) * 4 / 3,
                        0};
  return shape;
}

BladeOutline MakeBladeOutline(const ScissorsSpec& spec, bool upper) {
  const Eigen::Vector2d backwards(-1, 0);
  const double w = spec.width_mm;
  BladeOutline outline;
  outline.edge = EdgeShapeOf(spec, upper);
  outline.shank_path = ShankPathOf(spec);
  outline.shank_half_mm = 0.5 * spec.shank_mm;
  const double joint_low = std::min(outline.edge.At(0), -0.40 * w);  // room for the screw
  outline.back_mm = std::max(outline.edge.At(0) + w, 0.45 * w);

  AppendEdge(&outline.body, outline.edge);
  const Eigen::Vector2d tip_end =
      AppendTip(&outline.body, outline.edge, spec.tip_radius_mm, outline.back_mm);
  AppendSmooth(&outline.body, tip_end, {0.1 * w, outline.back_mm}, backwards);
  const Eigen::Vector2d shank_side(0, outline.shank_half_mm);
  AppendSmooth(&outline.body, backwards, outline.shank_path[0] + shank_side, backwards);
  AppendShank(&outline.body, outline.shank_path, outline.shank_half_mm, true);
  AppendShank(&outline.body, outline.shank_path, outline.shank_half_mm, false);
  const Eigen::Vector2d forwards(1, 0);
  AppendSmooth(&outline.body, forwards, {-spec.joint_mm + 0.2 * w, joint_low}, Direction(-0.9));
  const double heel_slope = std::atan(outline.edge.SlopeAt(outline.edge.from_mm));
  AppendSmooth(&outline.body,
               forwards,
               {outline.edge.from_mm, outline.edge.At(outline.edge.from_mm)},
               Direction(heel_slope));
  outline.body.pop_back();  // the heel, where the ring began
  PlaceRing(spec, &outline);
  return outline;
}

Ring ScrewRim(double radius_mm) {
  return Ellipse(Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(radius_mm), false);
}

Ring ScrewSlot(const ScissorsSpec& spec) {
  constexpr double kHalfWidth = 0.16, kHalfLength = 0.97;  // of the radius; it cuts through the rim
  const double from = std::max(-1.0, spec.slot_off.x() - kHalfLength);  // no further than the head
  const double to = std::min(1.0, spec.slot_off.x() + kHalfLength);
  const double low = spec.slot_off.y() - kHalfWidth, high = spec.slot_off.y() + kHalfWidth;
  Ring slot;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(from, low),
                                        Eigen::Vector2d(to, low),
                                        Eigen::Vector2d(to, high),
                                        Eigen::Vector2d(from, high)}) {
    slot.push_back(Eigen::Rotation2Dd(spec.slot_rad) * (spec.screw_radius_mm * corner));
  }
  return slot;
}

Eigen::Vector2d ScissorsFromBlade(const Eigen::Vector2d& blade_mm, bool upper, double theta_rad) {
  const Eigen::Vector2d upright(blade_mm.x(), upper ? blade_mm.y() : -blade_mm.y());
  return Eigen::Rotation2Dd(upper ? theta_rad / 2 : -theta_rad / 2) * upright;
}

Eigen::Vector2d BladeFromScissors(const Eigen::Vector2d& scissors_mm,
                                  bool upper,
                                  double theta_rad) {
  const Eigen::Vector2d turned =
      Eigen::Rotation2Dd(upper ? -theta_rad / 2 : theta_rad / 2) * scissors_mm;
  return {turned.x(), upper ? turned.y() : -turned.y()};
}

Eigen::Vector2d WorldFromScissors(const Eigen::Vector2d& scissors_mm, const SceneSpec& scene) {
  return scene.pivot_mm + Eigen::Rotation2Dd(scene.heading_rad) * scissors_mm;
}

Eigen::Vector2d ScissorsFromWorld(const Eigen::Vector2d& world_mm, const SceneSpec& scene) {
  return Eigen::Rotation2Dd(-scene.heading_rad) * (world_mm - scene.pivot_mm);
}

}  // namespace render
}  // namespace bladecurve
