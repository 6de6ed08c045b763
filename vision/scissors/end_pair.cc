// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/end_pair.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/refused.h"
#include "vision/scale/plane_map.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A blade's length in the plane of the edges, from the pivot to its distal end.
struct Reach {
  Vector2d along_px = Vector2d::Zero();  // unit, along the edge towards the tip
  double length = 0;
  double sigma = 0;
  bool outwards = false;  // the edge runs away from the pivot at its end, as cutting edges do
  double per_px = 0;      // growth of the length as the end moves along the edge
  Vector2d per_pivot_px = Vector2d::Zero();  // the same as the pivot moves
};

// Of the edge's last quarter, clear of the tip.
Vector2d DirectionAtEnd(const LocatedBlade& blade) {
  const Vector2d& from = blade.used[blade.used.size() * 3 / 4].trend_px;
  return (blade.used.back().trend_px - from).normalized();
}

Reach ReachOf(const PlaneMap& map,
              const Vector2d& pivot_px,
              const LocatedBlade& blade,
              const DistalEnd& end) {
  const auto length = [&](const Vector2d& from_px, const Vector2d& to_px) {
    return (map.PlaneFromImage(to_px) - map.PlaneFromImage(from_px)).norm();
  };
  const Vector2d& end_px = end.point_px;
  Reach reach;
  reach.along_px = DirectionAtEnd(blade);
  reach.length = length(pivot_px, end_px);
  reach.per_px = length(pivot_px, end_px + reach.along_px) - reach.length;
  reach.sigma = reach.per_px * end.along_sigma_px;
  constexpr double kOutwards = 0.7;  // cosine; edges keep within 30 degrees of the ray to their end
  reach.outwards = reach.per_px > kOutwards * length(end_px, end_px + reach.along_px);
  for (int k = 0; k < 2; ++k)
    reach.per_pivot_px[k] = length(pivot_px + Vector2d::Unit(k), end_px) - reach.length;
  return reach;
}

// `by` in units of the length, outwards.
void MoveEnd(const Reach& reach, double by, LocatedBlade* blade) {
  DistalEnd& end = blade->end;
  end.point_px += by / reach.per_px * reach.along_px;
  end.index = InliersBefore(blade->edge, end.point_px, reach.along_px);
}

void SetSigma(const Reach& reach, double sigma, LocatedBlade* blade) {
  blade->end.along_sigma_px = sigma / reach.per_px;
}

// The two lengths side by side.
struct EndComparison {
  Reach upper, lower;
  double gap = 0;       // upper less lower
  double unlike = 0;    // by how much equal blades may differ as seen, standard
  double variance = 0;  // of the gap

  // Relative likelihood of the gap.
  [[nodiscard]] double Likeness() const { return std::exp(-0.5 * gap * gap / variance); }
  [[nodiscard]] bool Contradicts() const {
    constexpr double kContradict = 3;  // standard uncertainties
    return std::abs(gap) > kContradict * std::sqrt(variance);
  }
  [[nodiscard]] bool UpperIsShorter() const { return gap < 0; }
  [[nodiscard]] const Reach& Shorter() const { return UpperIsShorter() ? upper : lower; }
  [[nodiscard]] bool Outwards() const { return upper.outwards && lower.outwards; }
};

EndComparison Compare(const ScaleResult& scale,
                      const Pivot& pivot,
                      const Blades& blades,
                      const DistalEnd& upper_end,
                      const DistalEnd& lower_end) {
  // Of the length. Blades are ground in pairs; but photographed freely one of them looks up to an
  // eighth shorter.
  constexpr double kMade = 0.005, kSeenAtASlant = 0.06;
  const PlaneMap map = scale.map.value_or(PlaneMap::Uniform(1, 0, kPixelsSource));
  EndComparison both;
  both.upper = ReachOf(map, pivot.point_px, blades.upper, upper_end);
  both.lower = ReachOf(map, pivot.point_px, blades.lower, lower_end);
  both.gap = both.upper.length - both.lower.length;
  const Vector2d per_pivot_px = both.upper.per_pivot_px - both.lower.per_pivot_px;
  both.unlike = std::hypot((scale.sheet ? kMade : kSeenAtASlant) * both.upper.length,
                           std::sqrt(per_pivot_px.dot(pivot.covariance_px2 * per_pivot_px)));
  both.variance = both.upper.sigma * both.upper.sigma + both.lower.sigma * both.lower.sigma +
                  both.unlike * both.unlike;
  return both;
}

// Least squares of the two lengths and their likeness. Afterwards the two errors are alike, and the
// opening angle takes their sum: each end gets half the sum's variance, as if they were
// independent.
void Fuse(const EndComparison& both, Blades* blades) {
  const double upper = both.upper.sigma * both.upper.sigma;
  const double lower = both.lower.sigma * both.lower.sigma;
  const double sum = upper + lower - (upper - lower) * (upper - lower) / both.variance;
  MoveEnd(both.upper, -both.gap * upper / both.variance, &blades->upper);
  MoveEnd(both.lower, both.gap * lower / both.variance, &blades->lower);
  SetSigma(both.upper, std::sqrt(sum / 2), &blades->upper);
  SetSigma(both.lower, std::sqrt(sum / 2), &blades->lower);
}

// The upper blade's end is put at the lower one's length, or the other way round.
void Follow(const EndComparison& both, bool upper_follows, Blades* blades) {
  constexpr double kOfGap = 0.1;  // the edge is followed that far without being seen to the end
  const Reach& reach = upper_follows ? both.upper : both.lower;
  const Reach& known = upper_follows ? both.lower : both.upper;
  LocatedBlade& blade = upper_follows ? blades->upper : blades->lower;
  MoveEnd(reach, upper_follows ? -both.gap : both.gap, &blade);
  SetSigma(reach, std::hypot(known.sigma, both.unlike, kOfGap * both.gap), &blade);
}

// Nobody knows which of the two is wrong.
void DoubtBoth(const EndComparison& both, Blades* blades) {
  constexpr double kShare = 0.5;
  const double doubt = kShare * both.gap;
  SetSigma(both.upper, std::hypot(both.upper.sigma, doubt), &blades->upper);
  SetSigma(both.lower, std::hypot(both.lower.sigma, doubt), &blades->lower);
}

// Where one blade looks shorter than blades look at any slant that they are photographed at, or at
// most without a tip's arc, what is seen of it last may be no tip. Whether it is so.
bool DoubtFarShorterOne(const EndComparison& both, Blades* blades) {
  constexpr double kAtAnySlant = 0.125, kAtMost = 0.06;  // of the length
  constexpr double kShare = 0.5;                         // of the gap, standard
  LocatedBlade& shorter = both.UpperIsShorter() ? blades->upper : blades->lower;
  const double longer = std::max(both.upper.length, both.lower.length);
  const double by_slant = (shorter.end.arc_seen ? kAtAnySlant : kAtMost) * longer;
  if (std::abs(both.gap) < by_slant) return false;
  SetSigma(both.Shorter(), std::hypot(both.Shorter().sigma, kShare * both.gap), &shorter);
  return true;
}

// Whether an arc is seen across which the picture steps the other way than across the edge.
bool IsShadows(const DistalEnd& end) { return end.arc_seen && end.evidence == 0; }

// How far an end is to be believed: by no arc, by one that may be the shadow's, by one that is not.
constexpr int kShadowsRank = 1;
int Rank(const DistalEnd& end) { return IsShadows(end) ? kShadowsRank : 2 * int{end.arc_seen}; }

// One arc in ten of that kind is the shadow's indeed, up to 6 % of the length off.
void DoubtShadowsArc(const Pivot& pivot, LocatedBlade* blade) {
  constexpr double kOff = 0.02;  // of the length, standard
  DistalEnd& end = blade->end;
  if (!IsShadows(end)) return;
  end.along_sigma_px =
      std::hypot(end.along_sigma_px, kOff * (end.point_px - pivot.point_px).norm());
}

constexpr double kMoreClearly = 1.5;  // times the evidence

// How clearly a blade is seen to end about there: by its end's arc, or by one that differs from
// that by no more than either is known to. 0 by none.
double EvidenceOfEnd(const LocatedBlade& blade) {
  constexpr double kSame = 2;  // standard uncertainties
  double most = blade.end.evidence;
  for (const DistalEnd& rival : blade.rival_ends) {
    const double apart_px = (rival.point_px - blade.end.point_px).norm();
    if (apart_px < kSame * std::hypot(rival.along_sigma_px, blade.end.along_sigma_px))
      most = std::max(most, rival.evidence);
  }
  return most;
}

// Whether the shorter blade's tip fades into its ground. Nothing else makes a blade that much
// shorter than the other one: shadows of tips lie nearer, and are seen no better.
bool ShorterOneFades(const EndComparison& both, const Blades& blades) {
  constexpr double kFaded = 0.06;  // of the length
  if (std::abs(both.gap) < kFaded * both.upper.length) return false;
  const LocatedBlade& shorter = both.UpperIsShorter() ? blades.upper : blades.lower;
  const LocatedBlade& longer = both.UpperIsShorter() ? blades.lower : blades.upper;
  if (!shorter.end.arc_seen) return !longer.end.arc_seen;
  return EvidenceOfEnd(longer) > kMoreClearly * shorter.end.evidence;
}

// Of the ends that either blade may have, the two arcs at like lengths that are seen best: shadows
// of tips and borders of bevels end elsewhere on the two blades, or are fainter. One arc beside an
// end without any, where the likely one is a shadow's.
void ChooseAlikeEnds(const ScaleResult& scale, const Pivot& pivot, Blades* blades) {
  const auto evidence = [&](const DistalEnd& upper, const DistalEnd& lower) {
    const EndComparison both = Compare(scale, pivot, *blades, upper, lower);
    const bool alike =
        both.Outwards() && !both.Contradicts() && (scale.sheet || upper.certain || lower.certain);
    return alike ? both.Likeness() * (upper.evidence + lower.evidence) : 0;
  };
  const DistalEnd upper = blades->upper.end, lower = blades->lower.end;
  const auto candidates = [](const LocatedBlade& blade) {
    std::vector<DistalEnd> ends{blade.end};
    ends.insert(ends.end(), blade.rival_ends.begin(), blade.rival_ends.end());
    return ends;
  };
  double most = kMoreClearly * evidence(upper, lower);
  for (const DistalEnd& u : candidates(blades->upper)) {
    for (const DistalEnd& l : candidates(blades->lower)) {
      const double seen = evidence(u, l);
      const bool both_seen = u.arc_seen && l.arc_seen;
      if (seen <= most || !(both_seen || IsShadows(upper) || IsShadows(lower))) continue;
      most = seen;
      blades->upper.end = u;
      blades->lower.end = l;
    }
  }
}

// Where the shorter blade would end if it were as long as the other.
Vector2d EndOfEqual(const EndComparison& both, const Blades& blades) {
  const Reach& reach = both.Shorter();
  const LocatedBlade& blade = both.UpperIsShorter() ? blades.upper : blades.lower;
  return blade.end.point_px + std::abs(both.gap) / reach.per_px * reach.along_px;
}

}  // namespace

void AgreeOnEnds(const ScaleResult& scale, const Pivot& pivot, Blades* blades) {
  ChooseAlikeEnds(scale, pivot, blades);
  const auto compare = [&] {
    return Compare(scale, pivot, *blades, blades->upper.end, blades->lower.end);
  };
  const EndComparison both = compare();
  if (!both.Outwards()) return;
  blades->ends_contradict = both.Contradicts();
  const int upper_rank = Rank(blades->upper.end), lower_rank = Rank(blades->lower.end);
  if (scale.sheet && ShorterOneFades(both, *blades))
    return Follow(both, both.UpperIsShorter(), blades);
  if (scale.sheet && blades->ends_contradict) {
    if (upper_rank == lower_rank) return DoubtBoth(both, blades);
    if (std::max(upper_rank, lower_rank) > kShadowsRank)
      return Follow(both, lower_rank > upper_rank, blades);
  }
  if (!scale.sheet && DoubtFarShorterOne(both, blades)) blades->ends_contradict = true;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) DoubtShadowsArc(pivot, blade);
  if (scale.sheet) Fuse(compare(), blades);
}

void RefuseCutOffBlade(const ScaleResult& scale,
                       const Pivot& pivot,
                       const Blades& blades,
                       const cv::Size& picture) {
  constexpr double kShorter = 0.03;  // of the length
  if (!blades.ends_contradict) return;
  const auto is_outside = [&](const Vector2d& end) {
    return end.x() < 0 || end.y() < 0 || end.x() > picture.width - 1 ||
           end.y() > picture.height - 1;
  };
  const EndComparison both = Compare(scale, pivot, blades, blades.upper.end, blades.lower.end);
  const bool shorter =
      std::abs(both.gap) > kShorter * std::max(both.upper.length, both.lower.length);
  const bool cut_off = is_outside(blades.upper.end.point_px) ||
                       is_outside(blades.lower.end.point_px) ||
                       (shorter && is_outside(EndOfEqual(both, blades)));
  if (!cut_off) return;
  throw Refused(Reason::kBladesNotVisible,
                "edges: one blade ends before the other does, and as long as that it would run out "
                "of the picture; both tips must be inside it");
}

}  // namespace bladecurve
