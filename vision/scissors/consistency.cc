// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/consistency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "vision/edge/edge_curve.h"
#include "vision/image/cross.h"
#include "vision/parallel.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

// Bright metal on white: of a blade that is plain white only the outer side's outline is left.
void RefuseWhite(const LocatedEdge& edge) {
  constexpr double kWhite = 0.5;   // share of its length
  constexpr double kVague = 0.65;  // ambiguity
  if (edge.overexposed < kWhite || edge.ambiguity < kVague) return;
  throw Refused(Reason::kLowContrast,
                "edges: a blade or its background is plain white along " +
                    std::to_string(std::lround(100 * edge.overexposed)) +
                    " % of a cutting edge, which hardly shows there; expose less, or use a darker "
                    "background");
}

void RefuseWhite(const Blades& blades) {
  RefuseWhite(blades.upper.edge);
  RefuseWhite(blades.lower.edge);
}

void RefuseOutOfPlane(const Pivot& pivot, const Blades& blades) {
  if (!LieInNoPlane(pivot.asymmetry)) return;
  RefuseWhite(blades);
  throw Refused(
      Reason::kOutOfPlane,
      "pivot: the two cutting edges pass by the pivot at very different distances (" +
          std::to_string(std::abs(pivot.asymmetry)).substr(0, 4) +
          " of the blade's length); angled or bent blades cannot be measured from one view");
}

// Blades that open little do not say how far behind them they turn.
void RefuseUnknownPivot(const Pivot& pivot, const Blades& blades) {
  constexpr double kVaguest = 0.14;  // of the blades' length; theta is then good to a seventh
  if (pivot.source != "geometry") return;
  const double length_px = BladeLengthPx(pivot, blades);
  const double sigma_px = std::sqrt(pivot.covariance_px2.trace());
  if (sigma_px <= kVaguest * length_px) return;
  throw Refused(Reason::kAmbiguousPivot,
                "pivot: no screw is seen, and the silhouette places it to " +
                    std::to_string(std::lround(100 * sigma_px / length_px)) +
                    " % of the blades' length only; say where it is: --pivot X,Y; or open the "
                    "scissors wider");
}

void RefuseJaws(const Pivot& pivot, const Blades& blades) {
  if (pivot.overlap + pivot.overlap_sigma >= kSlenderestOverlap) return;
  RefuseWhite(blades);
  throw Refused(
      Reason::kNotScissors,
      "pivot: the two inner edges meet at the pivot instead of passing by it, like the "
      "jaws of a clamp, a forceps or a needle holder, which do not cut; if these are scissors, "
      "say where the screw is: --pivot X,Y");
}

constexpr double kVaguePx = 1;  // common uncertainty

// Seen from a known side, about a screw that is seen.
bool AreFarUnlikeAboutScrew(const Pivot& pivot, const ScaleResult& scale) {
  return scale.sheet && pivot.source == "screw" && AreFarUnlike(pivot.asymmetry);
}

// Whether the edges pass by a pivot that is seen or told so differently that one of them is in
// doubt.
bool PassUnlike(const Pivot& pivot) {
  return pivot.source != "geometry" && AreUnlike(pivot.asymmetry);
}

// Less certain by that much, standard, for reasons of its own.
void AddSigma(LocatedEdge* edge, double off_px) {
  edge->common_sigma_px = std::hypot(edge->common_sigma_px, off_px);
  edge->alone_sigma_px = std::hypot(edge->alone_sigma_px, off_px);
}

}  // namespace

double BladeLengthPx(const Pivot& pivot, const Blades& blades) {
  return 0.5 * ((blades.upper.end.point_px - pivot.point_px).norm() +
                (blades.lower.end.point_px - pivot.point_px).norm());
}

double PartedByPivotPx(const Pivot& pivot, const Blades& blades) {
  const Eigen::Vector2d ahead = (blades.upper.end.point_px - pivot.point_px).normalized() +
                                (blades.lower.end.point_px - pivot.point_px).normalized();
  const Eigen::Vector2d across = Eigen::Vector2d(-ahead.y(), ahead.x()).normalized();
  return 2 * std::sqrt(across.dot(pivot.covariance_px2 * across));
}

void RefuseInconsistent(const Pivot& pivot, const Blades& blades) {
  RefuseOutOfPlane(pivot, blades);
  RefuseJaws(pivot, blades);
  RefuseUnknownPivot(pivot, blades);
}

void RefuseClosed(const Pivot& pivot, const Blades& blades) {
  constexpr double kLeastRad = 3 * std::numbers::pi / 180;
  const Eigen::Vector2d upper = blades.upper.end.point_px - pivot.point_px;
  const Eigen::Vector2d lower = blades.lower.end.point_px - pivot.point_px;
  if (std::atan2(Cross(upper, lower), upper.dot(lower)) >= kLeastRad) return;  // y points down
  throw Refused(Reason::kClosed,
                "edges: the distal ends lie on each other, or the wrong way round; open the "
                "scissors by 5 degrees at least, and avoid hard shadows beside them");
}

bool PassByPivot(const Pivot& pivot) { return pivot.overlap >= kUsualOverlap; }

bool IsClear(const LocatedEdge& edge) {
  constexpr double kClear = 0.5;  // ambiguity
  return edge.ambiguity <= kClear && edge.common_sigma_px <= kVaguePx;
}

bool IsDoubtful(const LocatedEdge& edge) {
  constexpr double kDoubt = 0.75;  // ambiguity
  return edge.ambiguity > kDoubt || edge.common_sigma_px > kVaguePx;
}

bool IsFalseHead(const Pivot& pivot, const ScaleResult& scale, const Blades& blades) {
  return AreFarUnlikeAboutScrew(pivot, scale) && pivot.screw && IsFaint(*pivot.screw) &&
         IsClear(blades.upper.edge) && IsClear(blades.lower.edge);
}

void RefuseUnlikeEdges(const Pivot& pivot, const ScaleResult& scale, const Blades& blades) {
  if (!AreFarUnlikeAboutScrew(pivot, scale)) return;
  const double by_pivot = PartedByPivotPx(pivot, blades) / BladeLengthPx(pivot, blades);
  if (!AreFarUnlike(std::max(0.0, std::abs(pivot.asymmetry) - by_pivot))) return;
  throw Refused(Reason::kLowContrast,
                "edges: the two cutting edges are not each other's mirror images: they pass by the "
                "pivot at distances that differ by " +
                    std::to_string(std::abs(pivot.asymmetry)).substr(0, 5) +
                    " of the blade's length; one of them is the line of a bevel or a shadow. Use "
                    "another background or light; or, if this is no screw, say where it is: "
                    "--pivot X,Y");
}

void RefuseContestedHead(const Pivot& pivot, const ScaleResult& scale) {
  constexpr double kFar = 2.5;       // standard uncertainties
  constexpr double kMostOfNone = 8;  // evidence; beyond, nothing was taken for a head falsely
  if (!pivot.screw || !IsFaint(*pivot.screw) || pivot.screw->evidence > kMostOfNone) return;
  const bool mirrored = scale.sheet && !pivot.bent && !AreSuspect(pivot.asymmetry);
  if (pivot.off_geometry < kFar || mirrored) return;
  throw Refused(Reason::kAmbiguousPivot,
                "pivot: something round is faintly seen, but far from where the blades put the "
                "pivot; say where it is: --pivot X,Y; or light the screw");
}

void RefusePivotOffJoint(const Scene& scene, const Pivot& pivot) {
  constexpr double kSlack = 0.1;  // of the joint; pivots lie at 0.2 to 0.9 of it
  constexpr double kSigmas = 2;
  if (pivot.source == "hint") return;
  const Eigen::Vector2d joint = scene.crotch_px - scene.shank_crotch_px;
  const Eigen::Vector2d along = joint / joint.squaredNorm();
  const double share = along.dot(pivot.point_px - scene.shank_crotch_px);
  const double slack = kSlack + kSigmas * std::sqrt(along.dot(pivot.covariance_px2 * along));
  if (share > -slack && share < 1 + slack) return;
  throw Refused(Reason::kAmbiguousPivot,
                "pivot: the edges put it beyond where the " +
                    std::string(share < 0 ? "shanks" : "blades") +
                    " part, so that one of them is something else's border; use another ground or "
                    "softer light, or say where it is: --pivot X,Y");
}

void RefuseUnconfirmedScene(const Scene& scene, const ScaleResult& scale, const Pivot& pivot) {
  constexpr double kMost = 0.07;    // of the length; blades photographed at a slant differ by 0.05
  constexpr double kAlike = 0.015;  // of the length, in shape; where both are seen, up to 0.0125
  constexpr double kPlain = 0.8;    // quality; lines on a mat that cross look like worse ones
  const bool faint = pivot.screw && IsFaint(*pivot.screw);
  const bool seen = pivot.source != "geometry" && !(scene.second_look && faint);
  const bool at_a_slant = !scale.sheet || pivot.bent;
  const bool pass_alike =
      at_a_slant ? std::abs(pivot.asymmetry) < kMost : !AreUnlike(pivot.asymmetry);
  const bool mirrored = pass_alike && pivot.unlikeness < kAlike;
  const bool doubtful = scene.IsDoubtful() || (!seen && scene.quality < kPlain);
  if (!doubtful || (seen && mirrored)) return;
  if (!scene.IsDoubtful()) {
    throw Refused(
        Reason::kAmbiguousPivot,
        "pivot: no screw is seen, and the outline alone, as where the rings are out of the "
        "picture, does not tell for certain that these are scissors; show the rings as "
        "well, light the screw, or say where it is: --pivot X,Y");
  }
  throw Refused(Reason::kLowContrast,
                "edges: shadows or a ground as bright as the blades leave " +
                    std::string(scene.outlined ? "nothing but lines to tell them by"
                                               : "it in doubt what is blade") +
                    ", and " +
                    (seen ? "these do not mirror each other about the pivot"
                          : "no screw is seen that would confirm where the blades are") +
                    "; use another ground or softer light, or say where the screw is: --pivot X,Y");
}

void Doubt(LocatedEdge* edge, double off_px) {
  constexpr double kDoubt = 0.75;  // ambiguity
  edge->ambiguity = std::max(edge->ambiguity, kDoubt);
  AddSigma(edge, off_px);
}

void DoubtForRival(LocatedEdge* edge, double off_px) {
  Doubt(edge, off_px);
  edge->rival_sigma_px = std::hypot(edge->rival_sigma_px, off_px);
}

void SetRival(LocatedEdge* edge, double rival_px) {
  edge->rival_px = rival_px;
  edge->rival_path_px.clear();
  for (const LocatedEdgePoint& p : edge->points)
    edge->rival_path_px.push_back(p.trend_px + rival_px * p.normal);
}

double ByRivalPx(const LocatedBlade& blade) {
  return (blade.on_left ? 1 : -1) * blade.edge.rival_px;
}

void DoubtUnlikeEdges(const Pivot& pivot, Blades* blades) {
  constexpr double kOff = 0.1;    // sigma, of how unlike they pass; over annotated photographs
  constexpr double kShare = 0.6;  // sigma, of the way to the other one
  if (!PassUnlike(pivot)) return;
  const double length_px = BladeLengthPx(pivot, *blades);
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    LocatedEdge& edge = blade->edge;
    AddSigma(&edge, kOff * pivot.asymmetry * length_px);
    if (!AreAlike(pivot.asymmetry + ByRivalPx(*blade) / length_px)) continue;
    Doubt(&edge, kShare * edge.rival_px);
  }
}

void DoubtKinkedEdges(Blades* blades) {
  constexpr double kKinked = 0.003, kTwoLines = 0.02;  // of the edge's length
  constexpr double kLeastPx = 0.5, kTimes = 2, kMost = 0.95;
  const std::array<LocatedBlade*, 2> both{&blades->upper, &blades->lower};
  const std::vector<double> kinks_px = ParallelMap(
      2, [&](int i) { return OffPlainCurve(both[static_cast<std::size_t>(i)]->used, kMost); });
  for (std::size_t i = 0; i < both.size(); ++i) {
    LocatedBlade* const blade = both[i];
    const double kink_px = kinks_px[i];
    const double length_px = (blade->used.back().trend_px - blade->used.front().trend_px).norm();
    if (blade == &blades->upper && kink_px > kTwoLines * length_px) {
      throw Refused(Reason::kLowContrast,
                    "edges: the upper cutting edge leaves a blade's smooth course by " +
                        std::to_string(std::lround(kink_px)) +
                        " px, as where the line of a bevel or the border of a shadow is followed "
                        "part of the way; use another background or light");
    }
    if (kink_px > std::max({kKinked * length_px, kLeastPx, TotalSigma(blade->edge)}))
      Doubt(&blade->edge, kTimes * kink_px);
  }
}

void DoubtSofterEdge(Blades* blades) {
  // Standard uncertainty per px of blur, over annotated photographs; rendered scenes need a third.
  constexpr double kPerSofter = 1.2;
  const double softer_px = blades->upper.edge.blur_px - blades->lower.edge.blur_px;
  if (!std::isfinite(softer_px)) return;
  AddSigma(&(softer_px > 0 ? blades->upper : blades->lower).edge, kPerSofter * softer_px);
}

void DoubtUnlikePrint(const ScaleResult& scale, Blades* blades) {
  constexpr double kSharper = 0.7;  // of the blurs; of good edges in the sun 99 % exceed 0.78
  constexpr double kOffPx = 1;      // at least
  // Standard uncertainty per px of blur, as edges rendered in the sun are off.
  constexpr double kPerSharper = 1.5, kPerSofter = 0.7;
  const std::optional<double> print_px = PrintBlurPx(scale.markers);
  if (!print_px) return;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    LocatedEdge& edge = blade->edge;
    if (edge.blur_px < kSharper * *print_px) Doubt(&edge, kOffPx);
    if (!std::isfinite(edge.unbound_blur_px)) continue;
    const double softer_px = edge.unbound_blur_px - *print_px;
    const double off_px = std::max(kPerSofter * softer_px, -kPerSharper * softer_px);
    AddSigma(&edge, off_px);
  }
}

void DoubtLaterLook(const Scene& scene, const Pivot& pivot, Blades* blades) {
  constexpr double kOfLength = 0.01;  // over annotated photographs
  if (!scene.second_look) return;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower})
    AddSigma(&blade->edge, kOfLength * BladeLengthPx(pivot, *blades));
}

void DoubtUnlikeEnds(const Pivot& pivot, Blades* blades) {
  constexpr double kOfDifference = 0.3;
  if (!PassUnlike(pivot)) return;
  const double turned_px =
      kOfDifference * std::abs(pivot.asymmetry) * BladeLengthPx(pivot, *blades) / std::sqrt(2.0);
  for (LocatedBlade* blade : {&blades->upper, &blades->lower})
    blade->end.across_sigma_px = std::hypot(blade->end.across_sigma_px, turned_px);
}

}  // namespace bladecurve
