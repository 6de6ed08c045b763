// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/shadowed_edge.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/dark_band.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirrored_blade.h"

namespace bladecurve {
namespace {

// The blade along the inner side of a band beside its edge that may be a shadow, if it is seen.
std::optional<LocatedBlade> BladeWithinBand(const BladeView& view, const LocatedBlade& blade) {
  std::optional<LocatedEdge> edge = WithinBand(view, blade.edge, blade.on_left);
  if (!edge) return std::nullopt;
  return UnlessRefused([&] {
    LocatedBlade within = blade;
    within.edge = *std::move(edge);
    TrimToFree(view, &within);
    return within;
  });
}

// The kinds of shadow that an edge may be the border of. One that is brighter than the blade is a
// margin within the edge; elsewhere any step to bright ground would look like its beginning.
std::vector<Shadow> ShadowsWithin(const BladeView& view, const LocatedBlade& blade) {
  const auto margin = view.MarginOf(blade.edge, blade.on_left);
  if (margin && margin->than_blade == Shadow::kBrighter)
    return {Shadow::kDarker, Shadow::kBrighter};
  return {Shadow::kDarker};
}

}  // namespace

bool RelocateShadowedOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kLeastPx = 1.5;       // a thinner band cannot be told from blur
  constexpr double kLeastShare = 0.004;  // of the length; blades are ground alike to less
  constexpr double kLeft = 0.3, kLeftByDoubtful = 0.5;  // of the difference
  constexpr double kNearest = 1;                        // px
  constexpr double kSeen = 0.65;  // ambiguity; what texture shows is seen less
  const auto [outer, other] = OneOf(blades, !LiesInwards(blades->upper, pivot));
  const MirroredBladeSearch search{view, pivot, other, LineBetween(view, pivot, *blades)};
  if (std::abs(pivot.asymmetry) < kLeastShare || WayPx(search) < kLeastPx) return false;
  if (TypicalContrast(outer.edge) <= 0) return false;  // brighter than the ground: no shadow of it
  if (HardlyShowsBeside(other.edge, outer.edge)) return false;
  const double most_left = IsDoubtful(outer.edge) ? kLeftByDoubtful : kLeft;
  for (const Shadow shadow : ShadowsWithin(view, outer)) {
    const std::optional<RelocatedBlade> found = LookInShadow(search, kNearest, shadow);
    if (!found || found->blade.edge.ambiguity > kSeen || !AreAlike(found->asymmetry)) continue;
    if (LeftOfDifference(search, *found) > most_left) continue;
    ReplaceAssumed(search, *found, "inside a shadow, where the other one puts it", &outer);
    return true;
  }
  return false;
}

bool LeaveBothShadows(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kLeft = 0.5;  // of the difference
  const std::optional<LocatedBlade> upper = BladeWithinBand(view, blades->upper);
  const std::optional<LocatedBlade> lower =
      upper ? BladeWithinBand(view, blades->lower) : std::nullopt;
  if (!lower) return false;
  const double asymmetry = AsymmetryOf(view, pivot, *upper, *lower);
  if (std::abs(asymmetry) > kLeft * std::abs(pivot.asymmetry)) return false;
  blades->upper = *upper;
  blades->lower = *lower;
  blades->upper.moved = blades->lower.moved = "to the inner sides of the bands beside both";
  return true;
}

}  // namespace bladecurve
