// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/image/covariance.h"
#include "vision/parallel.h"
#include "vision/pivot/head_trust.h"
#include "vision/pivot/slot_search.h"
#include "vision/scene/joint.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The least radius of a head, of the width of the blades that it holds: of those in photographs and
// renderings few are below 0.2, none below 0.16. Where shanks are slender, what is as wide as they
// are may be a mark.
constexpr double kLeastOfBlade = 0.1;

double LeastRadiusPx(const Scene& scene) {
  return std::max(3.0, kLeastOfBlade * std::min(scene.left.width_px, scene.right.width_px));
}

// Heads of screws and rivets are a quarter to four fifths of the shank wide; engraved marks are
// smaller, and what is as wide as the shank is mostly its own outline.
ScrewSearch SearchForHead(const ScaleResult& scale,
                          const Scene& scene,
                          const Vector2d& guess_px,
                          double radius_px) {
  ScrewSearch search;
  if (scale.sheet && scale.map) search.view = scale.map->JacobianAt(guess_px).inverse();
  search.min_semi_axis_px = std::max(LeastRadiusPx(scene), 0.13 * scene.shank_width_px);
  search.max_semi_axis_px = std::max(search.min_semi_axis_px + 1, 0.4 * scene.shank_width_px);
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

// Near where geometry puts the pivot.
ScrewSearch SearchByGeometry(const HeadSearch& known) {
  constexpr double kNear = 0.35;  // of the shank's width
  return SearchForHead(
      known.scale, known.scene, known.by_geometry.point_px, kNear * known.scene.shank_width_px);
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
  search.min_semi_axis_px =
      std::max(std::min(kSmallest, share) * search.min_semi_axis_px, kLeastOfBlade * blades_px);
  return search;
}

// Half-lit heads within some standard uncertainties of where geometry puts the pivot.
ScrewSearch SearchHalfLit(const HeadSearch& known, double sigmas) {
  const double sigma_px = LargestSigma(known.by_geometry.covariance_px2);
  ScrewSearch search =
      SearchForHead(known.scale,
                    known.scene,
                    known.by_geometry.point_px,
                    std::max(3.0, std::min(sigmas * sigma_px, 0.5 * known.scene.shank_width_px)));
  search.half_lit = true;
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

// Whether it lies where blades or shanks have parted: between them is ground, dark in their shadow.
bool LiesBeyondCrotch(const Screw& screw, const Scene& scene) {
  const double share = ShareOfJoint(scene, screw.center_px);
  return share < 0 || share > 1;
}

// The head that is seen, unless it is in doubt and may be an outline about a crotch.
std::optional<Screw> Find(const cv::Mat& grey,
                          const ScaleResult& scale,
                          const Scene& scene,
                          const ScrewSearch& search) {
  const std::optional<Screw> screw = FindScrew(grey, scale.tone, search);
  if (!screw || screw->evidence > kBeyondDoubt) return screw;
  const bool about_crotch = RunsThroughCrotch(*screw, scene) || LiesBeyondCrotch(*screw, scene);
  return about_crotch ? std::nullopt : screw;
}

std::optional<Screw> FindHere(const HeadSearch& known, const ScrewSearch& search) {
  const std::optional<Screw> screw = Find(known.grey, known.scale, known.scene, search);
  const bool is_none = screw && (LiesAstray(*screw, known) || IsTooFlat(*screw, known));
  return is_none ? std::nullopt : screw;
}

// What is seen in each of the searches, side by side.
std::vector<std::optional<Screw>> FindInEach(const HeadSearch& known,
                                             const std::vector<ScrewSearch>& searches) {
  return ParallelMap(static_cast<int>(searches.size()),
                     [&](int i) { return FindHere(known, searches[static_cast<std::size_t>(i)]); });
}

// What was seen at the joint; as long as that leaves doubts, also where geometry puts the pivot,
// nearer, so that fewer other arcs compete, and further back. The clearest counts that is credible
// where it lies.
std::optional<Screw> LookForScrew(const HeadSearch& known) {
  const Scene& scene = known.scene;
  std::optional<Screw> clearest = known.at_joint;
  if (clearest && clearest->evidence > kBeyondDoubt) return clearest;
  if (clearest && (IsTooFlat(*clearest, known) || !IsCredibleThere(*clearest, known)))
    clearest.reset();
  for (const std::optional<Screw>& screw :
       FindInEach(known, {SearchByGeometry(known), SearchOverlap(known.scale, scene, 0.25)})) {
    if (clearest && clearest->evidence > kBeyondDoubt) break;
    if (!screw || !IsCredibleThere(*screw, known)) continue;
    if (!clearest || Credence(*screw) > Credence(*clearest)) clearest = screw;
  }
  return clearest;
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

// The bright bar near where the blades put the pivot, where a slanted view may part the edges, if
// all that lie near there run through one place.
std::optional<Screw> LoneBrightBar(const std::vector<Screw>& bars, const HeadSearch& known) {
  constexpr double kSigmas = 1.7, kApart = 0.5;  // of a radius
  std::optional<Screw> lone;
  for (const Screw& bar : bars) {
    if (!bar.slot->bright || !LiesWhereBladesTurn(bar, known, kSigmas) || !MayPassAlike(bar, known))
      continue;
    if (!lone) lone = bar;
    if ((bar.center_px - lone->center_px).norm() >= kApart * lone->semi_major_px)
      return std::nullopt;
  }
  if (lone) lone->slot->alone = true;
  return lone;
}

// A head by its slot alone, where the blades put the pivot and about which the edges mirror each
// other; the nearest to there. About one that mirrors the light its rim must show, or no other lie
// near there.
std::optional<Screw> LookForSlot(const HeadSearch& known) {
  const std::vector<Screw> heads =
      FindSlottedHeads(known.grey, known.scale.tone, SearchAllAbout(known.scale, known.scene, 0));
  const auto off = [&](const Screw& screw) {
    return (screw.center_px - known.by_geometry.point_px).norm();
  };
  std::optional<Screw> nearest;
  for (const Screw& head : heads) {
    if (!LiesWhereBladesTurn(head, known) || !MirrorNear(head, known)) continue;
    if (nearest && off(head) >= off(*nearest)) continue;
    if (!head.slot->bright || ShowsRim(head, known)) nearest = head;
  }
  return nearest ? nearest : LoneBrightBar(heads, known);
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

// A flush head of which no more than a fine line shows, where geometry puts the pivot.
std::optional<Screw> LookForFineRim(const HeadSearch& known) {
  constexpr double kLeastPx = 1.5 * kJudgedRadiusPx;  // smaller ones are seen as they are
  ScrewSearch search = SearchByGeometry(known);
  search.min_semi_axis_px = std::max(search.min_semi_axis_px, kLeastPx);
  if (search.max_semi_axis_px < search.min_semi_axis_px) return std::nullopt;
  search.fine_rims = true;
  const std::optional<Screw> head = FindHere(known, search);
  return head && IsSureAtJoint(*head, known) ? head : std::nullopt;
}

// A half-lit head that is sure: nearly all of two thirds of its rim.
std::optional<Screw> LookForHalfLit(const HeadSearch& known) {
  constexpr double kSigmas = 2;
  constexpr double kClear = 10;  // elsewhere about the joint one of 700 scenes reaches it
  ScrewSearch search = SearchHalfLit(known, kSigmas);
  search.least_evidence = kClear;
  const auto head = FindHere(known, search);
  return head && IsSureHalfLit(*head, known) ? head : std::nullopt;
}

// In an unknown view of a scene that is in doubt so is where the blades turn.
bool MayTurnAbout(const Screw& screw, const HeadSearch& known) {
  if (!LiesWhereBladesTurn(screw, known)) return false;
  if (known.scale.sheet) return MirrorNear(screw, known);
  return (screw.evidence > kUnmistakable || !known.scene.IsDoubtful()) &&
         MayMirrorAbout(screw, known);
}

// Right where the blades turn an arc that is no head elsewhere is one, half lit: at 350
// photographed joints grain and glints stay below 7 there, and every second head of which nothing
// else was seen reaches 8. It may follow a part of the head, unless nothing else looks like it.
std::optional<Screw> LookWhereBladesTurn(const HeadSearch& known) {
  constexpr double kClearThere = 8;  // evidence
  constexpr double kSmaller = 0.6;   // so that others lie in the middle of an octave
  constexpr double kSpeck = 0.85;    // of the smallest usual head; smaller ones are a part of it
  constexpr double kAside = 0.25;    // of the radius, standard
  std::vector<ScrewSearch> searches(2, SearchHalfLit(known, 1));
  const double speck_px = kSpeck * searches.front().min_semi_axis_px;
  searches.back().min_semi_axis_px *= kSmaller;
  for (ScrewSearch& search : searches) search.least_evidence = kClearThere;
  std::optional<Screw> head = ClearestIn(known, searches, MayTurnAbout);
  if (!head || head->evidence > kUnmistakable) return head;
  if (head->semi_major_px < speck_px) return std::nullopt;
  head->covariance_px2 += std::pow(kAside * head->semi_major_px, 2) * Eigen::Matrix2d::Identity();
  return head;
}

// Where no head was seen that can be trusted: one further forward; one along the overlap; a
// wider or a smaller one; one with a fine rim; one of which nothing but the slot shows; a half-lit
// one.
std::optional<Screw> LookFurther(const HeadSearch& known) {
  const ScaleResult& scale = known.scale;
  const Scene& scene = known.scene;
  const auto forward = FindHere(known, SearchOverlap(scale, scene, 0.75));
  if (forward && (forward->evidence > kBeyondDoubt || MirrorNear(*forward, known))) return forward;
  if (auto head = ClearestIn(known, PiecesAlongOverlap(known), IsSureAtJoint)) return head;
  const std::vector unusual{SearchWideHead(scale, scene), SearchSmallHead(scale, scene)};
  if (auto head = ClearestIn(known, unusual, IsSureOfUnusualSize)) return head;
  if (auto head = LookForFineRim(known)) return head;
  if (auto slotted = LookForSlot(known)) return slotted;
  return LookForHalfLit(known);
}

// A head that can be told from all else about the joint.
std::optional<Screw> LookAllAbout(const HeadSearch& known) {
  const std::optional<Screw> seen = LookForScrew(known);
  if (seen && !IsFaint(*seen)) return seen;
  const std::optional<Screw> further = LookFurther(known);
  if (!seen) return further;
  if (MayMirrorAbout(*seen, known))
    return further && further->evidence > seen->evidence ? further : seen;
  return !further && MirrorNear(*seen, known) ? seen : further;
}

// A small head, looked at twice as large. In photographs and renderings those of which nothing was
// seen before reach 6.2 then; most other arcs about the joint stay below 5.6, but glints reach 8.7.
std::optional<Screw> LookMagnified(const HeadSearch& known) {
  constexpr double kLeastEvidence = 6;
  std::vector<ScrewSearch> searches = PiecesAlongOverlap(known);
  for (ScrewSearch& search : searches) {
    if (search.min_semi_axis_px > kJudgedRadiusPx) return std::nullopt;
    search.max_semi_axis_px = std::min(search.max_semi_axis_px, kJudgedRadiusPx);
    search.magnified = true;
    search.least_evidence = kLeastEvidence;
  }
  return ClearestIn(known, searches, IsSureMagnified);
}

}  // namespace

std::optional<Screw> LookAtJoint(const cv::Mat& grey,
                                 const ScaleResult& scale,
                                 const Scene& scene) {
  return Find(grey, scale, scene, SearchOverlap(scale, scene, 0.5));
}

std::optional<Screw> FindHead(const HeadSearch& search) {
  if (auto head = LookAllAbout(search)) return head;
  if (auto head = LookMagnified(search)) return head;
  return LookWhereBladesTurn(search);
}

}  // namespace bladecurve
