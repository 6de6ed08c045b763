// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/pivot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "vision/image/covariance.h"
#include "vision/pivot/head_place.h"
#include "vision/pivot/head_search.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

Pivot FromGeometry(const Scene& scene, const EdgeMirror& mirror) {
  const Estimate behind = BehindByGeometry(scene, mirror);
  Pivot pivot;
  pivot.source = "geometry";
  pivot.point_px = mirror.point_px - behind.value * mirror.direction;
  pivot.geometry_px = pivot.point_px;
  // A blade that is not quite the other's mirror image moves the line: by a few percent of the
  // shank's width, over photographs by two of the blades' length.
  constexpr double kOfWidth = 0.05, kOfLength = 0.02;
  const double across_sigma = std::max(
      {0.5, kOfWidth * scene.shank_width_px, kOfLength * (mirror.length_px + behind.value)});
  pivot.covariance_px2 = AlongAcross(mirror.direction, behind.sigma, across_sigma);
  return pivot;
}

// What the picture says of the edges' overlap: without a screw, where the members cross.
Estimate OverlapSeen(const ScaleResult& scale,
                     const Pivot& pivot,
                     const PivotSearch& search,
                     const EdgeMirror& mirror) {
  Estimate behind = BehindByWaist(search.scene, mirror);
  if (pivot.source != "geometry") {
    behind = {(mirror.point_px - pivot.point_px).dot(mirror.direction),
              std::sqrt(mirror.direction.dot(pivot.covariance_px2 * mirror.direction))};
  }
  const double length = std::max(1.0, mirror.length_px + behind.value);
  const Vector2d place_px = mirror.point_px - behind.value * mirror.direction;
  return {EdgeOverlap(SeenFromAbove(scale, search.edges, place_px), place_px),
          mirror.sine * behind.sigma / length};
}

// Whether a screw that is plainly seen lies elsewhere than a hint: further off than somebody who
// points to it misses it, and than its head is seen off its foot.
bool LiesElsewhere(const std::optional<Screw>& screw, const Vector2d& hint_px) {
  constexpr double kMissedPx = 3, kOff = 0.3;  // of the radius
  return screw && screw->evidence > kBeyondDoubt &&
         (screw->center_px - hint_px).norm() > std::max(kMissedPx, kOff * screw->semi_major_px);
}

// How far apart two places are, in standard uncertainties of their distance.
double SigmasApart(const Pivot& a, const Pivot& b) {
  return std::sqrt(ChiSquare(a.point_px - b.point_px, a.covariance_px2 + b.covariance_px2));
}

// The edges about the pivot. Those of bent blades are no mirror images, and nothing is said of
// them.
void Compare(const ScaleResult& scale,
             const PivotSearch& search,
             const EdgeMirror& mirror,
             Pivot* pivot) {
  const EdgePair edges = SeenFromAbove(scale, search.edges, pivot->point_px);
  pivot->bent = pivot->source != "geometry" && AreBentToOneSide(edges, pivot->point_px);
  pivot->asymmetry = pivot->bent ? 0 : EdgeAsymmetry(edges, pivot->point_px);
  pivot->unlikeness = pivot->bent ? 0 : EdgeUnlikeness(edges, pivot->point_px);
  const Estimate overlap = OverlapSeen(scale, *pivot, search, mirror);
  pivot->overlap = overlap.value;
  pivot->overlap_sigma = overlap.sigma;
  pivot->off_geometry =
      pivot->source == "geometry" ? 0 : SigmasApart(*pivot, FromGeometry(search.scene, mirror));
}

}  // namespace

Pivot FindPivot(const cv::Mat& grey, const ScaleResult& scale, const PivotSearch& search) {
  const EdgeMirror mirror = MirrorOf(search.edges);
  Pivot pivot = FromGeometry(search.scene, mirror);
  const std::optional<Screw> head = FindHead({grey,
                                              scale,
                                              search.scene,
                                              search.edges,
                                              {pivot.point_px, pivot.covariance_px2},
                                              search.at_joint});
  if (search.hint_px) {
    pivot.point_px = *search.hint_px;
    pivot.covariance_px2.setIdentity();
    pivot.source = "hint";
    pivot.off_screw = LiesElsewhere(head, *search.hint_px);
  } else {
    pivot.screw = head;
  }
  if (pivot.screw) {
    const PlacePx foot = FootBelow(*pivot.screw, scale, search.scene);
    pivot.point_px = foot.point_px;
    pivot.covariance_px2 = foot.covariance_px2;
    pivot.source = "screw";
  }
  Compare(scale, search, mirror, &pivot);
  return pivot;
}

void CompareEdges(const ScaleResult& scale,
                  const Scene& scene,
                  const EdgePair& edges,
                  Pivot* pivot) {
  Compare(scale, {scene, edges, std::nullopt}, MirrorOf(edges), pivot);
}

Pivot PivotByBlades(const ScaleResult& scale, const Scene& scene, const EdgePair& edges) {
  const EdgeMirror mirror = MirrorOf(edges);
  Pivot pivot = FromGeometry(scene, mirror);
  Compare(scale, {scene, edges, std::nullopt}, mirror, &pivot);
  return pivot;
}

}  // namespace bladecurve
