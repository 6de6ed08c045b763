// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_relocation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/consistency.h"
#include "vision/edge_pair.h"
#include "vision/pivot_geometry.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A blade located anew.
struct Relocated {
  LocatedBlade blade;
  double asymmetry = 0;
};

double LengthPx(const Pivot& pivot, const LocatedBlade& blade) {
  return (blade.end.point_px - pivot.point_px).norm();
}

// Where `other` puts `blade`.
EdgeGuess GuessWhereMirrored(const MirrorLine& line,
                             const Pivot& pivot,
                             const LocatedBlade& blade,
                             const LocatedBlade& other,
                             double nearest_px) {
  constexpr double kOfWay = 0.35;  // that the edge would move
  EdgeGuess guess;
  for (const LocatedEdgePoint& p : other.edge.points) {
    if (p.inlier) guess.path_px.push_back(line.Reflected(p.trend_px));
  }
  guess.blade_on_left = blade.on_left;
  guess.search_px =
      std::max(nearest_px, kOfWay * std::abs(pivot.asymmetry) * LengthPx(pivot, other));
  return guess;
}

// The blade with that edge, if enough of it is free.
std::optional<Relocated> WithEdge(const MirrorView& view,
                                  const Pivot& pivot,
                                  LocatedEdge edge,
                                  const LocatedBlade& blade,
                                  const LocatedBlade& other) {
  Relocated found;
  found.blade.on_left = blade.on_left;
  found.blade.edge = std::move(edge);
  try {
    TrimToFree(view.photo, view.scene, &found.blade);
  } catch (const Refused&) {
    return std::nullopt;
  }
  found.asymmetry = EdgeAsymmetry(PairOf(found.blade, other), pivot.point_px);
  return found;
}

// What is seen where `other` puts `blade`, as far aside of it.
std::optional<Relocated> LookWithin(double search_px,
                                    const MirrorView& view,
                                    const MirrorLine& line,
                                    const Pivot& pivot,
                                    const LocatedBlade& blade,
                                    const LocatedBlade& other) {
  const EdgeGuess guess = GuessWhereMirrored(line, pivot, blade, other, search_px);
  try {
    return WithEdge(
        view, pivot, LocateBladeAlong(view.photo, view.scale, view.scene, guess), blade, other);
  } catch (const Refused&) {
    return std::nullopt;
  }
}

// `blade` where `other` puts it, if it is seen there and the two are alike then.
std::optional<Relocated> LookWhereMirrored(const MirrorView& view,
                                           const MirrorLine& line,
                                           const Pivot& pivot,
                                           const LocatedBlade& blade,
                                           const LocatedBlade& other) {
  constexpr double kNearest = 5, kShortOf = 0.6;   // px; of the way to where it was
  constexpr double kMuchLess = 0.5, kSame = 0.85;  // of the difference before, where there is one
  const auto left = [&](const std::optional<Relocated>& found) {
    return std::abs(found->asymmetry) / std::abs(pivot.asymmetry);
  };
  const bool suspect = AreSuspect(pivot.asymmetry);
  std::optional<Relocated> found = LookWithin(kNearest, view, line, pivot, blade, other);
  if (suspect && found && left(found) > kSame) {  // the line that is doubted
    const double way_px = std::abs(pivot.asymmetry) * LengthPx(pivot, other);
    found = LookWithin(kShortOf * way_px, view, line, pivot, blade, other);
  }
  if (!found || (suspect && left(found) >= kMuchLess)) return std::nullopt;
  return AreAlike(found->asymmetry) ? found : std::nullopt;
}

void Replace(const Relocated& found, LocatedBlade* blade, Pivot* pivot) {
  *blade = found.blade;
  pivot->asymmetry = found.asymmetry;
}

// Whether it is the other blade's mirror image that lies further out.
bool LiesInwards(const LocatedBlade& blade, const Pivot& pivot) {
  return blade.on_left ? pivot.asymmetry < 0 : pivot.asymmetry > 0;
}

// Whether `blade` is to be taken from where it was found. An edge that alone is seen where the
// other one puts it, further out, is the border: before it was a line on the blade, a bevel's,
// however clear.
bool IsBetter(const std::optional<Relocated>& found,
              const LocatedBlade& blade,
              bool seen_alone_outside) {
  constexpr double kClearer = 0.5, kAlone = 0.6;  // ambiguity
  if (!found) return false;
  const LocatedEdge& edge = found->blade.edge;
  if (seen_alone_outside && edge.ambiguity <= kAlone) return true;
  return edge.ambiguity <= kClearer &&
         std::abs(TypicalContrast(edge)) > std::abs(TypicalContrast(blade.edge));
}

// Edges that do not mirror each other: the one that is better seen where the other puts it.
void RelocateClearerOne(const MirrorView& view, Pivot* pivot, Blades* blades) {
  const MirrorLine line = LineBetween(view, *pivot, *blades);
  const std::optional<Relocated> upper =
      LookWhereMirrored(view, line, *pivot, blades->upper, blades->lower);
  const std::optional<Relocated> lower =
      LookWhereMirrored(view, line, *pivot, blades->lower, blades->upper);
  const bool upper_better =
      IsBetter(upper, blades->upper, !lower && LiesInwards(blades->upper, *pivot));
  const bool lower_better =
      IsBetter(lower, blades->lower, !upper && LiesInwards(blades->lower, *pivot));
  if (upper_better == lower_better) return;  // either, or neither
  if (upper_better) {
    Replace(*upper, &blades->upper, pivot);
  } else {
    Replace(*lower, &blades->lower, pivot);
  }
}

// Edges that mirror each other but for a little, of which the outer one may be a shadow's border:
// the place where a shadow begins, where the other one puts it, if that accounts for the
// difference.
bool RelocateShadowedOne(const MirrorView& view, Pivot* pivot, Blades* blades) {
  constexpr double kLeastPx = 1.5;       // a thinner band cannot be told from blur
  constexpr double kLeastShare = 0.004;  // of the length; blades are ground alike to less
  constexpr double kLeft = 0.3;          // of the difference
  constexpr double kNearest = 1;         // px
  constexpr double kSeen = 0.65;         // ambiguity; what texture shows is seen less
  const bool is_upper = !LiesInwards(blades->upper, *pivot);
  LocatedBlade& outer = is_upper ? blades->upper : blades->lower;
  const LocatedBlade& other = is_upper ? blades->lower : blades->upper;
  const double differs = std::abs(pivot->asymmetry);
  if (differs < kLeastShare || differs * LengthPx(*pivot, other) < kLeastPx) return false;
  const MirrorLine line = LineBetween(view, *pivot, *blades);
  std::optional<LocatedEdge> edge = LocateBladeInShadow(
      view.photo, view.scale, view.scene, GuessWhereMirrored(line, *pivot, outer, other, kNearest));
  if (!edge) return false;
  const std::optional<Relocated> found = WithEdge(view, *pivot, *std::move(edge), outer, other);
  if (!found || found->blade.edge.ambiguity > kSeen) return false;
  if (!AreAlike(found->asymmetry) || std::abs(found->asymmetry) > kLeft * differs) return false;
  Replace(*found, &outer, pivot);
  return true;
}

// A doubtful edge, where the other one, if clear, puts it, if that leaves less doubt.
void RelocateDoubtfulOne(const MirrorView& view, Pivot* pivot, Blades* blades) {
  constexpr double kLess = 0.75;  // of the ambiguity before
  const bool is_upper = IsDoubtful(blades->upper.edge);
  LocatedBlade& doubtful = is_upper ? blades->upper : blades->lower;
  const LocatedBlade& other = is_upper ? blades->lower : blades->upper;
  if (!IsDoubtful(doubtful.edge) || !IsClear(other.edge)) return;
  const MirrorLine line = LineBetween(view, *pivot, *blades);
  std::optional<Relocated> found = LookWhereMirrored(view, line, *pivot, doubtful, other);
  if (!found) return;
  const LocatedEdge &before = doubtful.edge, &after = found->blade.edge;
  if (after.ambiguity < kLess * before.ambiguity && after.common_sigma_px <= before.common_sigma_px)
    Replace(*found, &doubtful, pivot);
}

}  // namespace

void RelocateUnlikeEdges(const MirrorView& view, Pivot* pivot, Blades* blades) {
  if (!KnowsMirror(view, *pivot)) return;
  if (RelocateShadowedOne(view, pivot, blades)) return;
  if (AreSuspect(pivot->asymmetry)) {
    RelocateClearerOne(view, pivot, blades);
  } else {
    RelocateDoubtfulOne(view, pivot, blades);
  }
}

}  // namespace bladecurve
