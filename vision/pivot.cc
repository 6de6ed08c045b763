// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// From the first to the last point of the edge's proximal 60 %: before a curved blade bends away.
struct Chord {
  Vector2d point, direction;
};

Chord ProximalChord(const std::vector<Vector2d>& edge) {
  const std::size_t last = std::max<std::size_t>(1, edge.size() * 3 / 5);
  return {edge.front(), (edge[std::min(last, edge.size() - 1)] - edge.front()).normalized()};
}

// The line about which the two chords mirror each other: a point and a unit direction towards the
// tips.
Chord MirrorLine(const EdgePair& edges) {
  const Chord a = ProximalChord(edges.left_px);
  const Chord b = ProximalChord(edges.right_px);
  const Vector2d direction = (a.direction + b.direction).normalized();
  const double sine = Cross(a.direction, b.direction);
  if (std::abs(sine) < 0.02) return {0.5 * (a.point + b.point), direction};  // nearly parallel
  return {a.point + Cross(b.point - a.point, b.direction) / sine * a.direction, direction};
}

// Covariance with different sigmas along and across a unit direction.
Eigen::Matrix2d AlongAcross(const Vector2d& along, double along_sigma, double across_sigma) {
  const Vector2d across(-along.y(), along.x());
  return along_sigma * along_sigma * along * along.transpose() +
         across_sigma * across_sigma * across * across.transpose();
}

Pivot FromGeometry(const Scene& scene, const EdgePair& edges) {
  const Chord mirror = MirrorLine(edges);
  Pivot pivot;
  pivot.source = "geometry";
  const double along = (scene.pivot_px - mirror.point).dot(mirror.direction);
  pivot.point_px = mirror.point + along * mirror.direction;
  pivot.geometry_px = pivot.point_px;
  // A blade that is not quite the other's mirror image moves the line by a few percent of the
  // shank's width.
  const double across_sigma = std::max(0.5, 0.05 * scene.shank_width_px);
  // Over rendered scissors without a visible screw the waist errs by that much more than it seems.
  constexpr double kWaistErrs = 1.3;
  pivot.covariance_px2 =
      AlongAcross(mirror.direction, kWaistErrs * scene.pivot_sigma_px, across_sigma);
  return pivot;
}

// The rim of a head stands above the plane of the edges by the thickness of a blade and of the
// head.
constexpr double kHeadMm = 2.0, kHeadSigmaMm = 0.6;

// Seen a little from the side, the head is not where the axis meets the plane of the edges. Without
// markers nobody knows from which side: heads are about a tenth of the shank's width high, views
// about five degrees off.
PlacePx BelowHead(const Vector2d& head_px, const ScaleResult& scale, const Scene& scene) {
  if (scale.sheet) {
    return FootOf(*scale.sheet, {head_px, scale.plane_height_mm, kHeadMm, kHeadSigmaMm});
  }
  const double sigma = 0.1 * scene.shank_width_px * std::tan(5 * std::numbers::pi / 180);
  return {head_px, sigma * sigma * Eigen::Matrix2d::Identity()};
}

// The rim's own scatter cannot tell that light falling from one side moves all of it: over rendered
// heads of brushed metal the centre is off by 2 % of the radius. Where one side follows something
// else than the rim, the ellipse is too short across it by as much as its centre is off; 2 % is
// what a view 11 degrees off the axis explains.
Eigen::Matrix2d ShadingCovariance(const Screw& screw) {
  constexpr double kShading = 0.02, kFlattened = 0.02;
  const double even_px = kShading * screw.semi_major_px;
  const double one_sided_px =
      std::max(0.0, (1 - kFlattened) * screw.semi_major_px - screw.semi_minor_px);
  const Vector2d major(std::cos(screw.angle_rad), std::sin(screw.angle_rad));
  return AlongAcross(major, even_px, std::hypot(even_px, one_sided_px));
}

// ln of the odds that this is the head, fitted all round: views seldom flatten one by more.
double Credence(const Screw& screw) {
  constexpr double kUsualFlattening = 0.05;
  const double sigmas = (1 - screw.semi_minor_px / screw.semi_major_px) / kUsualFlattening;
  return screw.evidence - 0.5 * sigmas * sigmas;
}

// A near look first: fewer other arcs compete. Where that leaves doubts, all along the overlap,
// where joints put their screws: a fifth to three fifths of the way from the shanks' crotch to the
// blades'; the clearest counts.
std::optional<Screw> LookForScrew(const cv::Mat& grey,
                                  const ToneCurve& tone,
                                  const Scene& scene,
                                  const Vector2d& guess_px) {
  ScrewSearch search;
  // Heads of screws and rivets are a quarter to nine tenths of the shank wide; engraved marks are
  // smaller.
  search.min_semi_axis_px = std::max(3.0, 0.13 * scene.shank_width_px);
  search.max_semi_axis_px = std::max(4.0, 0.45 * scene.shank_width_px);
  search.guess_px = guess_px;
  search.radius_px = 0.35 * scene.shank_width_px;
  constexpr double kBeyondDoubt = 20;  // evidence; shadows and facets of the joint reach 12
  std::optional<Screw> clearest = FindScrew(grey, tone, search);
  if (clearest && clearest->evidence > kBeyondDoubt) return clearest;
  const Vector2d overlap = scene.crotch_px - scene.shank_crotch_px;
  for (const double share : {0.25, 0.4, 0.55}) {
    search.guess_px = scene.shank_crotch_px + share * overlap;
    search.radius_px =
        std::clamp(0.15 * overlap.norm(), 0.3 * scene.shank_width_px, 0.7 * scene.shank_width_px);
    const std::optional<Screw> screw = FindScrew(grey, tone, search);
    if (screw && (!clearest || Credence(*screw) > Credence(*clearest))) clearest = screw;
  }
  return clearest;
}

}  // namespace

double EdgeAsymmetry(const EdgePair& edges, const Vector2d& pivot_px) {
  const Chord a = ProximalChord(edges.left_px);
  const Chord b = ProximalChord(edges.right_px);
  const double left = Cross(a.direction, pivot_px - a.point);
  const double right = -Cross(b.direction, pivot_px - b.point);
  const double length =
      0.5 * ((edges.left_px.back() - pivot_px).norm() + (edges.right_px.back() - pivot_px).norm());
  return std::abs(left - right) / std::max(1.0, length);
}

Pivot FindPivot(const cv::Mat& grey, const ScaleResult& scale, const PivotSearch& search) {
  Pivot pivot = FromGeometry(search.scene, search.edges);
  if (search.hint_px) {
    pivot.point_px = *search.hint_px;
    pivot.covariance_px2.setIdentity();
    pivot.source = "hint";
  } else {
    pivot.screw = LookForScrew(grey, scale.tone, search.scene, pivot.point_px);
  }
  if (pivot.screw) {
    const PlacePx foot = BelowHead(pivot.screw->center_px, scale, search.scene);
    pivot.point_px = foot.point_px;
    pivot.covariance_px2 =
        pivot.screw->covariance_px2 + ShadingCovariance(*pivot.screw) + foot.covariance_px2;
    pivot.source = "screw";
  }
  pivot.asymmetry = EdgeAsymmetry(search.edges, pivot.point_px);
  return pivot;
}

}  // namespace bladecurve
