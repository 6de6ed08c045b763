// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/consistency.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Covariance with different sigmas along and across a unit direction.
Eigen::Matrix2d AlongAcross(const Vector2d& along, double along_sigma, double across_sigma) {
  const Vector2d across(-along.y(), along.x());
  return along_sigma * along_sigma * along * along.transpose() +
         across_sigma * across_sigma * across * across.transpose();
}

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

// A rim that is hardly seen may be seen in parts, and parts of something else. Over heads rendered
// elsewhere the centre is off by 10 % of the radius where the odds are least, like others from odds
// of e^15 on.
double DoubtOfFaintRim(const Screw& screw) {
  constexpr double kFaint = 5, kClear = 15, kMost = 0.1;
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
  const double chi_square = apart.dot((a.covariance_px2 + b.covariance_px2).ldlt().solve(apart));
  const Eigen::Matrix2d covariance = a.covariance_px2 - share * a.covariance_px2;
  return {a.point_px + share * apart,
          std::max(1.0, chi_square / kByChance) * 0.5 * (covariance + covariance.transpose())};
}

// By its rim, and by its slot where it has one.
PlacePx CentreOf(const Screw& screw) {
  const PlacePx rim{screw.center_px, screw.covariance_px2 + ShapeCovariance(screw)};
  if (!screw.slot) return rim;
  return Combined(rim, {screw.slot->center_px, screw.slot->covariance_px2});
}

// ln of the odds that this is the head, fitted all round: views seldom flatten one by more.
double Credence(const Screw& screw) {
  constexpr double kUsualFlattening = 0.05;
  const double sigmas = (1 - screw.semi_minor_px / screw.semi_major_px) / kUsualFlattening;
  return screw.evidence - 0.5 * sigmas * sigmas;
}

// Heads of screws and rivets are a quarter to nine tenths of the shank wide; engraved marks are
// smaller.
ScrewSearch SearchForHead(const ScaleResult& scale,
                          const Scene& scene,
                          const Vector2d& guess_px,
                          double radius_px) {
  ScrewSearch search;
  if (scale.sheet && scale.map) search.view = scale.map->JacobianAt(guess_px).inverse();
  search.min_semi_axis_px = std::max(3.0, 0.13 * scene.shank_width_px);
  search.max_semi_axis_px = std::max(4.0, 0.45 * scene.shank_width_px);
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

// A half-lit head where geometry puts the pivot: nearly all of two thirds of its rim.
ScrewSearch SearchHalfLit(const ScaleResult& scale, const Scene& scene, const Pivot& geometry) {
  constexpr double kSigmas = 2;
  constexpr double kClear = 10;  // elsewhere reach 8.6
  const double sigma_px = std::sqrt(geometry.covariance_px2.eigenvalues().real().maxCoeff());
  ScrewSearch search =
      SearchForHead(scale,
                    scene,
                    geometry.point_px,
                    std::clamp(kSigmas * sigma_px, 3.0, 0.5 * scene.shank_width_px));
  search.half_lit = true;
  search.least_evidence = kClear;
  return search;
}

// What was seen at the joint; as long as that leaves doubts, also where geometry puts the pivot,
// nearer, so that fewer other arcs compete, and further back. The clearest counts.
std::optional<Screw> LookForScrew(const cv::Mat& grey,
                                  const ScaleResult& scale,
                                  const PivotSearch& known,
                                  const Vector2d& guess_px) {
  const Scene& scene = known.scene;
  std::optional<Screw> clearest = known.at_joint;
  for (const ScrewSearch& search :
       {SearchForHead(scale, scene, guess_px, 0.35 * scene.shank_width_px),
        SearchOverlap(scale, scene, 0.25)}) {
    if (clearest && clearest->evidence > kBeyondDoubt) break;
    const std::optional<Screw> screw = FindScrew(grey, scale.tone, search);
    if (screw && (!clearest || Credence(*screw) > Credence(*clearest))) clearest = screw;
  }
  return clearest;
}

// Where the axis that `screw` shows meets the plane of the edges.
PlacePx FootBelow(const Screw& screw, const ScaleResult& scale, const Scene& scene) {
  const PlacePx head = CentreOf(screw);
  const PlacePx foot = BelowHead(head.point_px, scale, scene);
  return {foot.point_px, head.covariance_px2 + foot.covariance_px2};
}

// What the edges say of a head: see EdgeAsymmetry.
double AsymmetryAbout(const Screw& screw, const ScaleResult& scale, const PivotSearch& known) {
  return EdgeAsymmetry(known.edges, FootBelow(screw, scale, known.scene).point_px);
}

// Where no head was seen: one further forward; one all about the overlap, if faint then with a
// slot; a wider one; a half-lit one. Necks of members and engraved marks are round, too, but less
// so than heads; about few of them the edges mirror each other.
std::optional<Screw> LookFurther(const cv::Mat& grey,
                                 const ScaleResult& scale,
                                 const PivotSearch& known,
                                 const Pivot& geometry) {
  constexpr double kUnmistakable = 25, kFaintSlotted = 5;
  const auto mirrors = [&](const Screw& screw) {
    return !AreSuspect(AsymmetryAbout(screw, scale, known));
  };
  const auto forward = FindScrew(grey, scale.tone, SearchOverlap(scale, known.scene, 0.75));
  if (forward && (forward->evidence > kBeyondDoubt || mirrors(*forward))) return forward;
  const auto usual = FindScrew(grey, scale.tone, SearchAllAbout(scale, known.scene, kFaintSlotted));
  if (usual) {
    const bool slotted = usual->slot && usual->slot->ends_seen;
    const bool unlike = scale.sheet && !mirrors(*usual);  // a slanted view parts edges as well
    if (usual->evidence > kFaintHead || (slotted && !unlike)) return usual;
  }
  const auto wide = FindScrew(grey, scale.tone, SearchWideHead(scale, known.scene));
  if (wide && (wide->evidence > kUnmistakable || mirrors(*wide))) return wide;
  const auto half = FindScrew(grey, scale.tone, SearchHalfLit(scale, known.scene, geometry));
  return half && mirrors(*half) ? half : std::nullopt;
}

// A head all about the overlap that outdoes a faint one about which the edges are no mirror images
// by far: one about which they are, beyond doubt.
Screw LessFaint(const cv::Mat& grey,
                const ScaleResult& scale,
                const PivotSearch& known,
                const Screw& seen) {
  if (!IsFaint(seen) || !AreFarUnlike(AsymmetryAbout(seen, scale, known))) return seen;
  const std::optional<Screw> other =
      FindScrew(grey, scale.tone, SearchAllAbout(scale, known.scene, kBeyondDoubt));
  return other && !AreSuspect(AsymmetryAbout(*other, scale, known)) ? *other : seen;
}

// What the picture says of the edges' overlap: without a screw, where the members cross.
Estimate OverlapSeen(const Pivot& pivot, const PivotSearch& search, const EdgeMirror& mirror) {
  Estimate behind = BehindByWaist(search.scene, mirror);
  if (pivot.source != "geometry") {
    behind = {(mirror.point_px - pivot.point_px).dot(mirror.direction),
              std::sqrt(mirror.direction.dot(pivot.covariance_px2 * mirror.direction))};
  }
  const double length = std::max(1.0, mirror.length_px + behind.value);
  return {EdgeOverlap(search.edges, mirror.point_px - behind.value * mirror.direction),
          mirror.sine * behind.sigma / length};
}

// The edges about the pivot.
void Compare(const PivotSearch& search, const EdgeMirror& mirror, Pivot* pivot) {
  pivot->asymmetry = EdgeAsymmetry(search.edges, pivot->point_px);
  const Estimate overlap = OverlapSeen(*pivot, search, mirror);
  pivot->overlap = overlap.value;
  pivot->overlap_sigma = overlap.sigma;
}

}  // namespace

std::optional<Screw> LookAtJoint(const cv::Mat& grey,
                                 const ScaleResult& scale,
                                 const Scene& scene) {
  return FindScrew(grey, scale.tone, SearchOverlap(scale, scene, 0.5));
}

Pivot FindPivot(const cv::Mat& grey, const ScaleResult& scale, const PivotSearch& search) {
  const EdgeMirror mirror = MirrorOf(search.edges);
  Pivot pivot = FromGeometry(search.scene, mirror);
  if (search.hint_px) {
    pivot.point_px = *search.hint_px;
    pivot.covariance_px2.setIdentity();
    pivot.source = "hint";
  } else {
    const std::optional<Screw> seen = LookForScrew(grey, scale, search, pivot.point_px);
    pivot.screw =
        seen ? LessFaint(grey, scale, search, *seen) : LookFurther(grey, scale, search, pivot);
  }
  if (pivot.screw) {
    const PlacePx foot = FootBelow(*pivot.screw, scale, search.scene);
    pivot.point_px = foot.point_px;
    pivot.covariance_px2 = foot.covariance_px2;
    pivot.source = "screw";
  }
  Compare(search, mirror, &pivot);
  return pivot;
}

void CompareEdges(const Scene& scene, const EdgePair& edges, Pivot* pivot) {
  Compare({scene, edges, std::nullopt}, MirrorOf(edges), pivot);
}

Pivot PivotByBlades(const Scene& scene, const EdgePair& edges) {
  const EdgeMirror mirror = MirrorOf(edges);
  Pivot pivot = FromGeometry(scene, mirror);
  Compare({scene, edges, std::nullopt}, mirror, &pivot);
  return pivot;
}

}  // namespace bladecurve
