// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_glints.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace bladecurve {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;

// How far the foot lies out of the rim in each direction, px, and what that counts.
struct FootBorder {
  // Where no glint shows it, the rim itself may follow the chamfer's top.
  static constexpr double kUnlit = 0.1;

  ArrayXd out_px = ArrayXd::Zero(HeadSurroundings::kDirections);
  ArrayXd weight = ArrayXd::Constant(HeadSurroundings::kDirections, kUnlit);
};

// std::nullopt where too little of the chamfer shines, or so much that it is no glint.
std::optional<FootBorder> FootByGlints(const HeadSurroundings& around) {
  constexpr double kLeast = 0.1;                 // light
  constexpr double kFewest = 0.15, kMost = 0.6;  // of the directions
  constexpr double kFurthest = 0.28;             // out of the rim, of its radius
  const double plate = around.typical_plate(), step = plate - around.typical_head();
  if (step < 0) return std::nullopt;
  const double least = std::max(kLeast, HeadSurroundings::LeastGlint(step, plate));
  const ArrayXd& ridge = around.ridge();
  if (static_cast<double>((ridge >= least).count()) < kFewest * HeadSurroundings::kDirections)
    return std::nullopt;
  FootBorder foot;
  int lit = 0;
  for (int i = 0; i < HeadSurroundings::kDirections; ++i) {
    if (ridge[i] < least) continue;
    const Sector sector(around, i);
    Index brightest = 0;
    sector.light.segment(around.FirstBetween(), around.CountBetween()).maxCoeff(&brightest);
    const Borders glint = BordersAbout(around, sector, around.FirstBetween() + brightest);
    if (std::abs(glint.outer_px) > kFurthest * around.radius_px()) continue;
    foot.out_px[i] = glint.outer_px;
    foot.weight[i] = 1;
    ++lit;
  }
  const double share = static_cast<double>(lit) / HeadSurroundings::kDirections;
  if (share < kFewest || share > kMost) return std::nullopt;
  return foot;
}

// Of the circle through the foot, from that of the rim, in the rim's own directions. px
Vector2d CentreOf(const FootBorder& foot) {
  Eigen::MatrixX3d terms(HeadSurroundings::kDirections, 3);
  for (int i = 0; i < HeadSurroundings::kDirections; ++i)
    terms.row(i) << 1, HeadSurroundings::DirectionOf(i).transpose();
  const ArrayXd root = foot.weight.sqrt();
  const Eigen::Vector3d circle = (root.matrix().asDiagonal() * terms)
                                     .colPivHouseholderQr()
                                     .solve((root * foot.out_px).matrix());
  return circle.tail<2>();
}

}  // namespace

RimFit LeaveGlints(const HeadSurroundings& around, RimFit fit) {
  constexpr double kSigma = 0.3;  // of the way
  const std::optional<FootBorder> foot = FootByGlints(around);
  if (!foot) return fit;
  const Vector2d off_px = fit.rim.shape * CentreOf(*foot) / fit.rim.MeanRadius();
  fit.rim.center += off_px;
  fit.center_covariance += kSigma * kSigma * off_px * off_px.transpose();
  return fit;
}

}  // namespace bladecurve
