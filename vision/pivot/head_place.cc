// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_place.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "vision/image/covariance.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// How high the head stands, px.
double HeightPx(const ScaleResult& scale, const Scene& scene, const Vector2d& head_px) {
  constexpr double kOfShank = 0.4;  // of its width
  const bool in_mm = scale.map && scale.map->source() != kPixelsSource;
  if (!in_mm) return kOfShank * scene.shank_width_px;
  return kHeadMm / std::sqrt(std::abs(scale.map->JacobianAt(head_px).determinant()));
}

// Seen a little from the side, the head is not where the axis meets the plane of the edges. Without
// markers nobody knows from which side. A camera near by shows what stands aside of the picture's
// middle from there; where it is not known, nor whether the picture is but a part of another, that
// is no more than possible.
PlacePx BelowHead(const Vector2d& head_px, const ScaleResult& scale, const Scene& scene) {
  if (scale.sheet)
    return FootOf(*scale.sheet, {head_px, scale.plane_height_mm, kHeadMm, kHeadSigmaMm});
  const double height_px = HeightPx(scale, scene, head_px);
  PlacePx foot{head_px, std::pow(height_px * kFreehandSlantRad, 2) * Eigen::Matrix2d::Identity()};
  if (!scale.camera) return foot;
  const Camera& camera = scale.camera->camera;
  const Vector2d leaning =
      height_px / camera.focal_length_px() * (head_px - camera.k.topRightCorner<2, 1>());
  const bool known = scale.camera->log_focal_sigma < kFocalKnown;
  if (known) foot.point_px -= leaning;
  foot.covariance_px2 +=
      std::pow(known ? kHeadSigmaMm / kHeadMm : 1, 2) * leaning * leaning.transpose();
  return foot;
}

// A rim that is hardly seen may be seen in parts, and parts of something else. Over heads rendered
// elsewhere the centre is off by 10 % of the radius where the odds are least, like others from odds
// of e^25 on.
double DoubtOfFaintRim(const Screw& screw) {
  constexpr double kFaint = 5, kClear = 25, kMost = 0.1;
  return kMost * std::clamp((kClear - screw.evidence) / (kClear - kFaint), 0.0, 1.0);
}

// Of what the rim's fit cannot tell: a chamfer not alike all round, a rim not quite round. Over
// heads rendered elsewhere and brushed ones the centre is off by 1.2 % of the radius where
// every third of the rim looks like the rest, by 2 % where half of one does not.
double ShareOfShape(const Screw& screw) {
  constexpr double kAlike = 0.7, kUnlike = 0.5;  // support of the poorest third
  constexpr double kLeast = 0.012, kMost = 0.02;
  return kMost - (kMost - kLeast) *
                     std::clamp((screw.third_support - kUnlike) / (kAlike - kUnlike), 0.0, 1.0);
}

// The same, and that where one side follows something else than the rim, the ellipse is too short
// across it by as much as its centre is off; 2 % is what a view 11 degrees off the axis explains.
Eigen::Matrix2d ShapeCovariance(const Screw& screw) {
  constexpr double kFlattened = 0.02;
  const double even_px =
      std::hypot(ShareOfShape(screw), DoubtOfFaintRim(screw)) * screw.semi_major_px;
  const double one_sided_px =
      std::max(0.0, (1 - kFlattened) * screw.semi_major_px - screw.semi_minor_px);
  const Vector2d major(std::cos(screw.angle_rad), std::sin(screw.angle_rad));
  return AlongAcross(major, even_px, std::hypot(even_px, one_sided_px));
}

// Two estimates of one place as one; both are doubted where they part by more than chance explains.
PlacePx Combined(const PlacePx& a, const PlacePx& b) {
  constexpr double kByChance = 6;  // chi-square of two coordinates, 95 %
  const Vector2d apart = b.point_px - a.point_px;
  const Eigen::Matrix2d share = a.covariance_px2 * (a.covariance_px2 + b.covariance_px2).inverse();
  const double chi_square = ChiSquare(apart, a.covariance_px2 + b.covariance_px2);
  const Eigen::Matrix2d covariance = a.covariance_px2 - share * a.covariance_px2;
  return {a.point_px + share * apart,
          std::max(1.0, chi_square / kByChance) * 0.5 * (covariance + covariance.transpose())};
}

// By its rim, and by its slot where it has one.
PlacePx CentreOf(const Screw& screw) {
  const PlacePx rim{screw.center_px, screw.covariance_px2 + ShapeCovariance(screw)};
  if (!screw.slot) return rim;
  // A slot about what is hardly seen may be none.
  const double doubt_px = 0.5 * DoubtOfFaintRim(screw) * screw.semi_major_px;
  return Combined(rim,
                  {screw.slot->center_px,
                   screw.slot->covariance_px2 + doubt_px * doubt_px * Eigen::Matrix2d::Identity()});
}

}  // namespace

PlacePx FootBelow(const Screw& screw, const ScaleResult& scale, const Scene& scene) {
  const PlacePx head = CentreOf(screw);
  const PlacePx foot = BelowHead(head.point_px, scale, scene);
  return {foot.point_px, head.covariance_px2 + foot.covariance_px2};
}

}  // namespace bladecurve
