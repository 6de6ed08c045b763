// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "vision/render/render.h"
#include "vision/render/render_coverage.h"

namespace bladecurve::render {

// The midline of a shank, from the joint to its ring: a cubic Bezier in the blade's frame.
using ShankPath = std::array<Eigen::Vector2d, 4>;

// One of the two rigid bodies, seen from above, mm in its own frame (mirrored for the lower blade).
struct BladeOutline {
  EdgeShape edge;
  Ring body;  // blade and shank; starts at the heel and runs along the edge to the tip
  Ring ring_outer, ring_inner;  // the finger ring and its hole, which runs the other way
  ShankPath shank_path;
  double shank_half_mm = 0;  // half the width of the shank
  double back_mm = 0;        // height of the blade's back above the pivot
  Eigen::Vector2d ring_center_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d ring_middle_mm =
      Eigen::Vector2d::Zero();  // semi-axes of the middle of the ring's tube
  double tube_half_mm = 0;      // half the thickness of the tube
};

// The cutting edge that the spec describes; the upper and the lower one differ by `curve_mm`.
[[nodiscard]] EdgeShape EdgeShapeOf(const ScissorsSpec& spec, bool upper);

[[nodiscard]] BladeOutline MakeBladeOutline(const ScissorsSpec& spec, bool upper);

// The head of the screw and the slot across it, in the blade's frame.
[[nodiscard]] Ring ScrewRim(double radius_mm);
[[nodiscard]] Ring ScrewSlot(const ScissorsSpec& spec);

// Frames. Scissors: physics.md's; world: on the sheet.
[[nodiscard]] Eigen::Vector2d ScissorsFromBlade(const Eigen::Vector2d& blade_mm,
                                                bool upper,
                                                double theta_rad);
[[nodiscard]] Eigen::Vector2d BladeFromScissors(const Eigen::Vector2d& scissors_mm,
                                                bool upper,
                                                double theta_rad);
[[nodiscard]] Eigen::Vector2d WorldFromScissors(const Eigen::Vector2d& scissors_mm,
                                                const SceneSpec& scene);
[[nodiscard]] Eigen::Vector2d ScissorsFromWorld(const Eigen::Vector2d& world_mm,
                                                const SceneSpec& scene);

// Point of a cubic Bezier, t in [0, 1].
[[nodiscard]] Eigen::Vector2d BezierPoint(const std::array<Eigen::Vector2d, 4>& control, double t);

}  // namespace bladecurve::render
