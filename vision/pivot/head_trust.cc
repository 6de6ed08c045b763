// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_trust.h"

#include <algorithm>
#include <cmath>

#include "vision/image/covariance.h"
#include "vision/pivot/head_place.h"
#include "vision/pivot/head_search.h"
#include "vision/pivot/pivot_geometry.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kLeastOdds = 3;  // 20 to 1
constexpr double kFaint = 5;      // evidence of a head that something else must speak for

// With a bar from end to end of it.
bool IsSlotted(const Screw& screw) { return screw.slot && screw.slot->ends_seen; }

// Chi-square of a head against where the blades alone put the pivot.
double OffBlades(const Screw& screw, const HeadSearch& known) {
  return ChiSquare(screw.center_px - known.by_geometry.point_px, known.by_geometry.covariance_px2);
}

// The same of a place against where the silhouette alone puts the pivot, whichever line the edges
// were taken for.
double OffSilhouette(const Vector2d& place_px, const HeadSearch& known) {
  constexpr double kOfWidth = 0.1;  // of the members, standard
  const Scene& scene = known.scene;
  const Vector2d axis = (scene.crotch_px - scene.shank_crotch_px).normalized();
  return ChiSquare(
      place_px - scene.pivot_px,
      AlongAcross(axis, scene.pivot_sigma_px, std::max(1.0, kOfWidth * scene.shank_width_px)));
}

// ln of the odds of a head, as its rim, a slot and the place tell where the blades alone put the
// pivot: true heads keep to 3 standard deviations of that, arcs that look like heads lie anywhere.
// In a view that is not known an edge may be wrong, and with it the line about which the two mirror
// each other: the silhouette's place counts as well, for less.
double OddsAtPlace(const Screw& screw, const HeadSearch& known) {
  constexpr double kSlotted = 3, kEdgeWrong = 2;
  double off = OffBlades(screw, known);
  if (!known.scale.sheet)
    off = std::min(off, OffSilhouette(screw.center_px, known) + 2 * kEdgeWrong);
  return screw.evidence + (IsSlotted(screw) ? kSlotted : 0) - 0.5 * off;
}

// What the edges say of a place: see EdgeAsymmetry.
double AsymmetryAbout(const Vector2d& place_px, const HeadSearch& known) {
  return EdgeAsymmetry(SeenFromAbove(known.scale, known.edges, place_px), place_px);
}

double AsymmetryAbout(const Screw& screw, const HeadSearch& known) {
  return AsymmetryAbout(FootBelow(screw, known.scale, known.scene).point_px, known);
}

// Whether the edges mirror each other about a head.
bool MirrorAbout(const Screw& screw, const HeadSearch& known) {
  return !AreSuspect(AsymmetryAbout(screw, known));
}

}  // namespace

double Credence(const Screw& screw) {
  constexpr double kUsualFlattening = 0.05;
  const double sigmas = (1 - screw.semi_minor_px / screw.semi_major_px) / kUsualFlattening;
  return screw.evidence - 0.5 * sigmas * sigmas;
}

bool IsCredibleThere(const Screw& screw, const HeadSearch& known) {
  return screw.evidence > kFaintHead || known.scale.sheet || OddsAtPlace(screw, known) > kLeastOdds;
}

bool LiesAstray(const Screw& screw, const HeadSearch& known) {
  constexpr double kFar = 5;  // chi-square; 128 such heads in photographs reach 4.9
  if (known.scale.sheet || screw.evidence > kFaintHead || IsSlotted(screw)) return false;
  return std::min(OffBlades(screw, known), OffSilhouette(screw.center_px, known)) > kFar;
}

bool IsTooFlat(const Screw& screw, const HeadSearch& known) {
  constexpr double kFlattest = 0.85;  // ratio of the axes; 320 heads beside markers keep to 0.89
  return known.scale.sheet && screw.evidence <= kUnmistakable &&
         screw.semi_minor_px < kFlattest * screw.semi_major_px;
}

bool MirrorNear(const Screw& screw, const HeadSearch& known) {
  if (!known.scale.sheet) return MirrorAbout(screw, known);
  const PlacePx foot = FootBelow(screw, known.scale, known.scene);
  const double length_px = 0.5 * ((known.edges.left_px.back() - foot.point_px).norm() +
                                  (known.edges.right_px.back() - foot.point_px).norm());
  const double by_place = 2 * std::sqrt(0.5 * foot.covariance_px2.trace()) / length_px;
  const double asymmetry = std::abs(AsymmetryAbout(foot.point_px, known));
  if (screw.evidence < kFaint && AreUnlike(asymmetry)) return false;
  return !AreSuspect(std::max(0.0, asymmetry - by_place));
}

bool MayMirrorAbout(const Screw& screw, const HeadSearch& known) {
  constexpr double kSlanted = 0.1;
  if (known.scale.sheet) return MirrorAbout(screw, known);
  return Credence(screw) > 0 || std::abs(AsymmetryAbout(screw, known)) < kSlanted;
}

bool MayPassAlike(const Screw& screw, const HeadSearch& known) {
  // Of the blades' length: bright slots in photographs reach 0.044, steps at heels have 0.058.
  constexpr double kMost = 0.045;
  return !known.scale.sheet && !known.scene.IsDoubtful() &&
         std::abs(AsymmetryAbout(screw, known)) < kMost;
}

bool LiesWhereBladesTurn(const Screw& screw, const HeadSearch& known, double sigmas) {
  return OffBlades(screw, known) < sigmas * sigmas;
}

bool IsSureAtJoint(const Screw& screw, const HeadSearch& known) {
  const bool seen = screw.evidence > (known.scale.sheet ? kFaintestHead : kFaint);
  if (screw.evidence > kFaintHead || (seen && MirrorNear(screw, known))) return true;
  return ((seen && IsSlotted(screw)) || OddsAtPlace(screw, known) > kLeastOdds) &&
         MayMirrorAbout(screw, known);
}

bool IsSureOfUnusualSize(const Screw& screw, const HeadSearch& known) {
  if (screw.evidence > kUnmistakable || MirrorNear(screw, known)) return true;
  if (screw.evidence <= kFaint || !MayMirrorAbout(screw, known)) return false;
  return LiesWhereBladesTurn(screw, known) ||
         (IsSlotted(screw) && OddsAtPlace(screw, known) > kLeastOdds);
}

bool IsSureMagnified(const Screw& screw, const HeadSearch& known) {
  constexpr double kSigmas = 2;  // glints about the joint lie further off
  if (LiesWhereBladesTurn(screw, known) || MirrorNear(screw, known)) return true;
  if (known.scale.sheet || IsPartlySeen(screw)) return false;
  return (IsSlotted(screw) || LiesWhereBladesTurn(screw, known, kSigmas)) &&
         MayMirrorAbout(screw, known);
}

bool IsSureHalfLit(const Screw& screw, const HeadSearch& known) {
  constexpr double kSigmas = 2;
  return MirrorNear(screw, known) ||
         (!known.scale.sheet && IsSlotted(screw) && LiesWhereBladesTurn(screw, known, kSigmas) &&
          MayMirrorAbout(screw, known));
}

}  // namespace bladecurve
