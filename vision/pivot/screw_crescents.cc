// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_crescents.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "vision/pivot/head_surroundings.h"
#include "vision/pivot/screw_glints.h"

namespace bladecurve {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;

struct Crescents {
  Vector2d to_light = Vector2d::Zero();  // unit
  Borders bright;
  std::optional<Borders> dark;
  double depth = 0;  // of the dark one, of the step between head and plate
};

// The direction about which something bright lies, if it lies to one side; of kDirections.
std::optional<int> LitDirection(const HeadSurroundings& around) {
  constexpr int kDirections = HeadSurroundings::kDirections;
  constexpr double kToOneSide = 0.6;  // first harmonic over mean
  const ArrayXd& ridge = around.ridge();
  std::complex<double> harmonic = 0;
  for (int i = 0; i < kDirections; ++i) {
    const Vector2d direction = HeadSurroundings::DirectionOf(i);
    harmonic += ridge[i] * std::complex(direction.x(), direction.y());
  }
  if (ridge.sum() == 0 || std::abs(harmonic) < kToOneSide * ridge.sum()) return std::nullopt;
  const double turns = std::arg(harmonic) / (2 * std::numbers::pi);
  return (static_cast<int>(std::lround(turns * kDirections)) + kDirections) % kDirections;
}

std::optional<Crescents> FindCrescents(const HeadSurroundings& around, const RimEllipse& rim) {
  constexpr int kOpposite = HeadSurroundings::kDirections / 2;
  constexpr double kLeast = 0.015;        // light
  constexpr double kMostOpposite = 0.35;  // of the height
  constexpr double kWidest = 0.28;        // out of the rim, of its radius
  constexpr double kLeastStep = 0.02, kLeastDepth = 0.003, kLeastDeep = 0.08;
  const std::optional<int> lit = LitDirection(around);
  if (!lit) return std::nullopt;
  const double plate = around.typical_plate();
  const double step = std::max(kLeastStep, std::abs(around.typical_head() - plate));
  const Sector bright(around, *lit);
  Sector dark(around, (*lit + kOpposite) % HeadSurroundings::kDirections);
  // A wide one covers part of what is looked at of the head there.
  dark.head = std::max(dark.head, around.typical_head());
  const Index from = around.FirstBetween(), count = around.CountBetween();
  Index brightest = 0, darkest = 0;
  const double beside = std::max({bright.head, bright.plate, plate});
  const double height = bright.light.segment(from, count).maxCoeff(&brightest) - beside;
  const double opposite =
      dark.light.segment(from, count).maxCoeff() - std::max({dark.head, dark.plate, plate});
  const double least = std::max(kLeast, HeadSurroundings::LeastGlint(step, beside));
  if (height < least || opposite > kMostOpposite * height) return std::nullopt;
  Crescents found;
  found.to_light = (rim.shape * HeadSurroundings::DirectionOf(*lit)).normalized();
  found.bright = BordersAbout(around, bright, from + brightest);
  if (found.bright.outer_px > kWidest * around.radius_px()) return std::nullopt;
  const double depth =
      std::min(dark.head, dark.plate) - dark.light.segment(from, count).minCoeff(&darkest);
  if (depth > std::max(kLeastDepth, kLeastDeep * step)) {
    found.dark = BordersAbout(around, dark, from + darkest);
    found.depth = depth / step;
  }
  return found;
}

// How far the head lies from the rim's centre towards the light.
struct Lean {
  double px = 0, sigma_px = 0;
};

// The shares over ray-traced heads of 5 to 40 px and over this project's own, whose chamfers cast
// no shadow: of a rim that falls outwards both kinds lean alike; of one that rises those lean
// whose dark crescent is deep.
Lean LeanOf(const Crescents& crescents) {
  constexpr double kFalling = 0.6, kFallingSigma = 0.3;
  constexpr double kShallow = 0.2, kDeep = 0.4, kRisingSigma = 0.5;
  constexpr double kUnseen = 0.4, kUnseenSigma = 0.5;
  const bool at_outer = crescents.bright.RimIsOuter();
  if (!crescents.dark) {
    if (at_outer) return {};
    const double by_foot = 0.5 * crescents.bright.outer_px;
    return {kUnseen * by_foot, kUnseenSigma * by_foot};
  }
  if (at_outer == crescents.dark->RimIsOuter()) return {};
  const double by_top = 0.5 * (crescents.bright.inner_px - crescents.dark->inner_px);
  if (at_outer) return {kFalling * by_top, kFallingSigma * by_top};
  const double share = std::clamp((crescents.depth - kShallow) / (kDeep - kShallow), 0.0, 1.0);
  return {share * by_top, kRisingSigma * by_top};
}

}  // namespace

RimFit LeaveCrescents(const cv::Mat& light, RimFit fit) {
  const HeadSurroundings around(light, fit.rim);
  const std::optional<Crescents> crescents = FindCrescents(around, fit.rim);
  if (!crescents) return LeaveGlints(around, fit);
  const Lean lean = LeanOf(*crescents);
  const Vector2d& to_light = crescents->to_light;
  fit.rim.center += lean.px * to_light;
  fit.center_covariance += lean.sigma_px * lean.sigma_px * to_light * to_light.transpose();
  return fit;
}

}  // namespace bladecurve
