// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {

// Light on the way out of a head, in directions of its rim: a row each half pixel, a column each
// direction.
class HeadSurroundings {
 public:
  static constexpr int kDirections = 72;

  // light: CV_32F, linear, at full resolution.
  HeadSurroundings(const cv::Mat& light, const RimEllipse& rim);

  [[nodiscard]] static Eigen::Vector2d DirectionOf(int i);
  [[nodiscard]] const Eigen::ArrayXXd& light() const { return light_; }
  // Typical light of each direction, on the head and on the plate about it.
  [[nodiscard]] const Eigen::ArrayXd& head() const { return head_; }
  [[nodiscard]] const Eigen::ArrayXd& plate() const { return plate_; }
  // Of all directions.
  [[nodiscard]] double typical_head() const { return typical_head_; }
  [[nodiscard]] double typical_plate() const { return typical_plate_; }
  [[nodiscard]] double radius_px() const { return radius_px_; }
  [[nodiscard]] double OutOfRimPx(double row) const;

  // The rows between head and plate, where chamfers lie.
  [[nodiscard]] Eigen::Index FirstBetween() const;
  [[nodiscard]] Eigen::Index CountBetween() const;

  // How much brighter than head and plate it is somewhere between them, of each direction; than the
  // plate elsewhere, too, as a groove or another blade's shadow beside the head is no plate.
  [[nodiscard]] const Eigen::ArrayXd& ridge() const { return ridge_; }

  // How much brighter than what lies `beside` it a glint is at least: of the step between head and
  // plate, or of what is left up to white, if that is less.
  [[nodiscard]] static double LeastGlint(double step, double beside);

 private:
  [[nodiscard]] Eigen::Index RowsUpTo(double to) const;
  [[nodiscard]] Eigen::ArrayXd TypicalOf(Eigen::Index from, Eigen::Index to) const;

  double radius_px_ = 0;
  double step_ = 0;  // between rows, of the radius
  Eigen::ArrayXXd light_;
  Eigen::ArrayXd head_, plate_, ridge_;
  double typical_head_ = 0, typical_plate_ = 0;
};

// Typical of the directions about one of them.
struct Sector {
  Eigen::ArrayXd light;
  double head = 0, plate = 0;

  Sector(const HeadSurroundings& around, int middle);
};

// Of what is brighter, or darker, than head and plate, px out of the rim.
struct Borders {
  double inner_px = 0, outer_px = 0;

  // Whether the rim was followed along the outer one.
  [[nodiscard]] bool RimIsOuter() const;
};

// Where light, from its extreme between head and plate on, is half way to what lies there.
[[nodiscard]] Borders BordersAbout(const HeadSurroundings& around,
                                   const Sector& sector,
                                   Eigen::Index extreme);

}  // namespace bladecurve
