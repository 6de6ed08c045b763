// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/image/covariance.h"
#include "vision/parallel.h"
#include "vision/pivot/head_place.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/pivot/slot_search.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// ln of the odds that this is the head, fitted all round: views seldom flatten one by more.
double Credence(const Screw& screw) {
  constexpr double kUsualFlattening = 0.05;
  const double sigmas = (1 - screw.semi_minor_px / screw.semi_major_px) / kUsualFlattening;
  return screw.evidence - 0.5 * sigmas * sigmas;
}

// Heads of screws and rivets are a quarter to four fifths of the shank wide; engraved marks are
// smaller, and what is as wide as the shank is mostly its own outline.
ScrewSearch SearchForHead(const ScaleResult& scale,
                          const Scene& scene,
                          const Vector2d& guess_px,
                          double radius_px) {
  ScrewSearch search;
  if (scale.sheet && scale.map) search.view = scale.map->JacobianAt(guess_px).inverse();
  search.min_semi_axis_px = std::max(3.0, 0.13 * scene.shank_width_px);
  search.max_semi_axis_px = std::max(4.0, 0.4 * scene.shank_width_px);
  search.guess_px = guess_px;
  search.radius_px = radius_px;
  return search;
}

// About a place on the overlap, as a share of the way from the shanks' crotch to the blades'.
ScrewSearch SearchOverlap(const ScaleResult& scale, const Scene& scene, double share) {
  const Vector2d overlap = scene.crotch_px - scene.shank_crotch_px;
  const double radius_px =
      std::clamp(0.15 * overlap.norm(), 0.3 * scene.shank_width_px, 0.7 * scene.shank_width_px);
  return SearchForHead(scale, scene, scene.shank_crotch_px + share * overlap, radius_px);
}

// All about the overlap, for heads beyond doubt: crotches that shadows fill put it elsewhere.
ScrewSearch SearchAllAbout(const ScaleResult& scale, const Scene& scene, double least_evidence) {
  constexpr double kOfOverlap = 0.6;
  const Vector2d overlap = scene.crotch_px - scene.shank_crotch_px;
  ScrewSearch search = SearchForHead(
      scale, scene, scene.shank_crotch_px + 0.5 * overlap, kOfOverlap * overlap.norm());
  search.least_evidence = least_evidence;
  return search;
}

// The same for heads wider than usual: a waist that was measured across one shank alone is no wider
// than the head.
ScrewSearch SearchWideHead(const ScaleResult& scale, const Scene& scene) {
  constexpr double kWidest = 0.6;   // of the members, a head's radius
  constexpr double kOverlap = 0.8;  // of the widest usual one: between the two none is lost
  ScrewSearch search = SearchAllAbout(scale, scene, kFaintHead);
  const double members_px =
      std::max({scene.shank_width_px, scene.left.width_px, scene.right.width_px});
  search.min_semi_axis_px = kOverlap * search.max_semi_axis_px;
  search.max_semi_axis_px = std::max(search.max_semi_axis_px, kWidest * members_px);
  return search;
}

// Heads smaller than usual: small ones on broad joints, where joints mostly have theirs; and all
// about the overlap where the blades are so narrow that the shank looks far too wide, as the
// silhouette fills a gap beside it.
ScrewSearch SearchSmallHead(const ScaleResult& scale, const Scene& scene) {
  constexpr double kAtJoint = 0.42;  // of the overlap
  constexpr double kSmallest = 0.6;  // of the smallest usual head
  constexpr double kOfBlades = 2.2;  // shanks are no wider
  constexpr double kOverlap = 1.25;  // of the smallest usual head: between the two none is lost
  const double blades_px = 0.5 * (scene.left.width_px + scene.right.width_px);
  const double share = kOfBlades * blades_px / scene.shank_width_px;
  ScrewSearch search =
      share < 1 ? SearchAllAbout(scale, scene, kFaintHead) : SearchOverlap(scale, scene, kAtJoint);
  search.max_semi_axis_px = kOverlap * search.min_semi_axis_px;
  search.min_semi_axis_px *= std::min(kSmallest, share);
  return search;
}

// A half-lit head where geometry puts the pivot: nearly all of two thirds of its rim.
ScrewSearch SearchHalfLit(const HeadSearch& known) {
  constexpr double kSigmas = 2;
  constexpr double kClear = 10;  // elsewhere about the joint one of 700 scenes reaches it
  const double sigma_px = LargestSigma(known.by_geometry.covariance_px2);
  ScrewSearch search =
      SearchForHead(known.scale,
                    known.scene,
                    known.by_geometry.point_px,
                    std::max(3.0, std::min(kSigmas * sigma_px, 0.5 * known.scene.shank_width_px)));
  search.half_lit = true;
  search.least_evidence = kClear;
  return search;
}

// Whether the rim runs through one of the crotches, as outlines about them do and hardly any head.
bool RunsThroughCrotch(const Screw& screw, const Scene& scene) {
  constexpr double kNear = 0.2;  // of the radius
  const auto is_near = [&](const Vector2d& crotch_px) {
    const double radii = (screw.center_px - crotch_px).norm() / screw.semi_major_px;
    return std::abs(radii - 1) < kNear;
  };
  return is_near(scene.shank_crotch_px) || is_near(scene.crotch_px);
}

// The head that is seen, unless it is in doubt and runs through a crotch.
std::optional<Screw> Find(const cv::Mat& grey,
                          const ScaleResult& scale,
                          const Scene& scene,
                          const ScrewSearch& search) {
  const std::optional<Screw> screw = FindScrew(grey, scale.tone, search);
  if (!screw || screw->evidence > kBeyondDoubt || !RunsThroughCrotch(*screw, scene)) return screw;
  return std::nullopt;
}

std::optional<Screw> FindHere(const HeadSearch& known, const ScrewSearch& search) {
  return Find(known.grey, known.scale, known.scene, search);
}

// What is seen in each of the searches, side by side.
std::vector<std::optional<Screw>> FindInEach(const HeadSearch& known,
                                             const std::vector<ScrewSearch>& searches) {
  return ParallelMap(static_cast<int>(searches.size()),
                     [&](int i) { return FindHere(known, searches[static_cast<std::size_t>(i)]); });
}

// ln of the odds of a head, as its rim, a slot and the place tell where the blades alone put the
// pivot: true heads keep to 3 standard deviations of that, arcs that look like heads lie anywhere.
double OddsAtPlace(const Screw& screw, const HeadSearch& known) {
  constexpr double kSlotted = 3;
  const PlacePx& place = known.by_geometry;
  return screw.evidence + (screw.slot && screw.slot->ends_seen ? kSlotted : 0) -
         0.5 * ChiSquare(screw.center_px - place.point_px, place.covariance_px2);
}

constexpr double kLeastOdds = 3;  // 20 to 1

// Whether a head of which little shows lies near enough to there. In a known view the edges say
// more, by mirroring each other about it or not.
bool IsCredibleThere(const Screw& screw, const HeadSearch& known) {
  return screw.evidence > kFaintHead || known.scale.sheet || OddsAtPlace(screw, known) > kLeastOdds;
}

// What was seen at the joint; as long as that leaves doubts, also where geometry puts the pivot,
// nearer, so that fewer other arcs compete, and further back. The clearest counts that is credible
// where it lies.
std::optional<Screw> LookForScrew(const HeadSearch& known) {
  const Scene& scene = known.scene;
  std::optional<Screw> clearest = known.at_joint;
  if (clearest && clearest->evidence > kBeyondDoubt) return clearest;
  if (clearest && !IsCredibleThere(*clearest, known)) clearest.reset();
  for (const std::optional<Screw>& screw :
       FindInEach(known,
                  {SearchForHead(
                       known.scale, scene, known.by_geometry.point_px, 0.35 * scene.shank_width_px),
                   SearchOverlap(known.scale, scene, 0.25)})) {
    if (clearest && clearest->evidence > kBeyondDoubt) break;
    if (!screw || !IsCredibleThere(*screw, known)) continue;
    if (!clearest || Credence(*screw) > Credence(*clearest)) clearest = screw;
  }
  return clearest;
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

// Whether they would about a place as near to it as it is known. One that lies aside adds to one
// edge's distance and takes from the other's.
bool MirrorNear(const Screw& screw, const HeadSearch& known) {
  if (!known.scale.sheet) return MirrorAbout(screw, known);
  const PlacePx foot = FootBelow(screw, known.scale, known.scene);
  const double length_px = 0.5 * ((known.edges.left_px.back() - foot.point_px).norm() +
                                  (known.edges.right_px.back() - foot.point_px).norm());
  const double by_place = 2 * std::sqrt(0.5 * foot.covariance_px2.trace()) / length_px;
  const double asymmetry = std::abs(AsymmetryAbout(foot.point_px, known));
  return !AreSuspect(std::max(0.0, asymmetry - by_place));
}

// Whether they mirror each other as far as the view is known. A slanted one parts edges as well,
// but hardly so much about what is too flat for a head.
bool MayMirrorAbout(const Screw& screw, const HeadSearch& known) {
  constexpr double kSlanted = 0.1;
  if (known.scale.sheet) return MirrorAbout(screw, known);
  return Credence(screw) > 0 || std::abs(AsymmetryAbout(screw, known)) < kSlanted;
}

// Whether it lies where the blades alone put the pivot.
bool LiesWhereBladesTurn(const Screw& screw, const HeadSearch& known) {
  const PlacePx& place = known.by_geometry;
  return ChiSquare(screw.center_px - place.point_px, place.covariance_px2) < 1;
}

// Whether some of a rim shows about the ends of a head's slot.
bool ShowsRim(const Screw& slotted, const HeadSearch& known) {
  constexpr double kAside = 0.25, kSmaller = 0.8, kLarger = 1.3;  // of the slot's half length
  const double radius_px = slotted.semi_major_px;
  ScrewSearch search =
      SearchForHead(known.scale, known.scene, slotted.center_px, kAside * radius_px);
  search.min_semi_axis_px = kSmaller * radius_px;
  search.max_semi_axis_px = kLarger * radius_px;
  search.half_lit = true;
  return FindHere(known, search).has_value();
}

// A head by its slot alone, where the blades put the pivot and about which the edges mirror each
// other; the nearest to there. About one that mirrors the light its rim must show.
std::optional<Screw> LookForSlot(const HeadSearch& known) {
  const auto off = [&](const Screw& screw) {
    return (screw.center_px - known.by_geometry.point_px).norm();
  };
  std::optional<Screw> nearest;
  for (const Screw& head : FindSlottedHeads(
           known.grey, known.scale.tone, SearchAllAbout(known.scale, known.scene, 0))) {
    if (!LiesWhereBladesTurn(head, known) || !MirrorNear(head, known)) continue;
    if (nearest && off(head) >= off(*nearest)) continue;
    if (!head.slot->bright || ShowsRim(head, known)) nearest = head;
  }
  return nearest;
}

// Three discs along the overlap instead of one all about it: in each, a head is judged by its own
// surroundings, and by as many candidates as in all of it. Between them they reach 0.4 of its
// radius aside of the line between the crotches; of 232 photographs no pivot lies further aside
// than 0.36.
std::vector<ScrewSearch> PiecesAlongOverlap(const HeadSearch& known) {
  constexpr double kRadius = 0.5, kApart = 0.6;  // of the whole disc's radius
  const Vector2d along = (known.scene.crotch_px - known.scene.shank_crotch_px).normalized();
  const ScrewSearch whole = SearchAllAbout(known.scale, known.scene, kFaintestHead);
  std::vector<ScrewSearch> pieces(3, whole);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].radius_px = kRadius * whole.radius_px;
    pieces[i].guess_px += (static_cast<double>(i) - 1) * kApart * whole.radius_px * along;
  }
  return pieces;
}

constexpr double kFaint = 5;  // evidence of a head that something else must speak for

// Whether a head near the joint is to be trusted: necks of members and engraved marks are round,
// too, but less so than heads, and about few of them the edges mirror each other, the fewest where
// the view is known.
bool IsSureAtJoint(const Screw& screw, const HeadSearch& known) {
  const bool seen = screw.evidence > (known.scale.sheet ? kFaintestHead : kFaint);
  if (screw.evidence > kFaintHead || (seen && MirrorNear(screw, known))) return true;
  const bool slotted = screw.slot && screw.slot->ends_seen;
  return ((seen && slotted) || OddsAtPlace(screw, known) > kLeastOdds) &&
         MayMirrorAbout(screw, known);
}

// The same of one that is wider or smaller than usual.
bool IsSureOfUnusualSize(const Screw& screw, const HeadSearch& known) {
  if (screw.evidence > kUnmistakable || MirrorNear(screw, known)) return true;
  const bool at_place = screw.evidence > kFaint && LiesWhereBladesTurn(screw, known);
  return at_place && MayMirrorAbout(screw, known);
}

// The clearest that is sure, of what is seen in each of the searches.
std::optional<Screw> ClearestIn(const HeadSearch& known,
                                const std::vector<ScrewSearch>& searches,
                                bool (*is_sure)(const Screw&, const HeadSearch&)) {
  std::optional<Screw> clearest;
  for (const std::optional<Screw>& screw : FindInEach(known, searches)) {
    const bool clearer = screw && (!clearest || screw->evidence > clearest->evidence);
    if (clearer && is_sure(*screw, known)) clearest = screw;
  }
  return clearest;
}

// Where no head was seen that can be trusted: one further forward; one along the overlap; a
// wider or a smaller one; one of which nothing but the slot shows; a half-lit one.
std::optional<Screw> LookFurther(const HeadSearch& known) {
  const ScaleResult& scale = known.scale;
  const Scene& scene = known.scene;
  const auto forward = FindHere(known, SearchOverlap(scale, scene, 0.75));
  if (forward && (forward->evidence > kBeyondDoubt || MirrorNear(*forward, known))) return forward;
  if (auto head = ClearestIn(known, PiecesAlongOverlap(known), IsSureAtJoint)) return head;
  const std::vector unusual{SearchWideHead(scale, scene), SearchSmallHead(scale, scene)};
  if (auto head = ClearestIn(known, unusual, IsSureOfUnusualSize)) return head;
  if (auto slotted = LookForSlot(known)) return slotted;
  const auto half = FindHere(known, SearchHalfLit(known));
  return half && MirrorNear(*half, known) ? half : std::nullopt;
}

}  // namespace

std::optional<Screw> LookAtJoint(const cv::Mat& grey,
                                 const ScaleResult& scale,
                                 const Scene& scene) {
  return Find(grey, scale, scene, SearchOverlap(scale, scene, 0.5));
}

std::optional<Screw> FindHead(const HeadSearch& search) {
  const std::optional<Screw> seen = LookForScrew(search);
  if (seen && !IsFaint(*seen)) return seen;
  const std::optional<Screw> further = LookFurther(search);
  if (!seen) return further;
  if (MayMirrorAbout(*seen, search))
    return further && further->evidence > seen->evidence ? further : seen;
  return !further && MirrorNear(*seen, search) ? seen : further;
}

}  // namespace bladecurve
