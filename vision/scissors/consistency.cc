// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/consistency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "vision/image/cross.h"
#include "vision/refused.h"
#include "vision/scene/joint.h"
#include "vision/scissors/edge_doubt.h"

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

// Whether what is seen of blades and screw leaves no doubt about how they lie to each other.
bool AreSurelySeen(const Pivot& pivot, const Blades& blades) {
  return pivot.screw && pivot.screw->evidence > kUnmistakable && IsClear(blades.upper.edge) &&
         IsClear(blades.lower.edge);
}

std::string HowToPoint(const Pivot& pivot) {
  return pivot.source == "hint" ? "check --pivot" : "say where the screw is: --pivot X,Y";
}

void RefuseJaws(const Pivot& pivot, const Blades& blades) {
  if (pivot.overlap + pivot.overlap_sigma >= kSlenderestOverlap) return;
  RefuseWhite(blades);
  const std::string detail =
      "pivot: the two inner edges meet at the pivot instead of passing by it, like the jaws of a "
      "clamp, a forceps or a needle holder, which do not cut; if these are scissors, ";
  if (AreSurelySeen(pivot, blades))
    throw RefusedForGood(Reason::kNotScissors, detail + HowToPoint(pivot));
  throw Refused(Reason::kNotScissors,
                detail + "one edge was taken elsewhere: use another background or light, or " +
                    HowToPoint(pivot));
}

// Seen from a known side, about a screw that is seen.
bool AreFarUnlikeAboutScrew(const Pivot& pivot, const ScaleResult& scale) {
  return scale.sheet && pivot.source == "screw" && AreFarUnlike(pivot.asymmetry);
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

bool DifferBeyondPivot(const Pivot& pivot, const Blades& blades, double sigmas) {
  return std::abs(pivot.asymmetry) * BladeLengthPx(pivot, blades) >
         sigmas * PartedByPivotPx(pivot, blades);
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
  const double share = ShareOfJoint(scene, pivot.point_px);
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
  const bool contested = pivot.screw && (pivot.bent ? IsHardlySeen(*pivot.screw)
                                                    : scene.second_look && IsFaint(*pivot.screw));
  const bool seen = pivot.source != "geometry" && !contested;
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
  const char* const why = pivot.bent ? "blades that are bent to one side do not confirm each other"
                          : seen     ? "these do not mirror each other about the pivot"
                                     : "no screw is seen that would confirm where the blades are";
  throw Refused(Reason::kLowContrast,
                "edges: shadows or a ground as bright as the blades leave " +
                    std::string(scene.outlined ? "nothing but lines to tell them by"
                                               : "it in doubt what is blade") +
                    ", and " + why + "; use another ground or softer light, or " +
                    HowToPoint(pivot));
}

}  // namespace bladecurve
