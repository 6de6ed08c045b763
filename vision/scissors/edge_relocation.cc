// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_relocation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/borrowed_edge.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/dark_band.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/ground_colour.h"
#include "vision/scissors/mirrored_blade.h"
#include "vision/scissors/shadowed_edge.h"
#include "vision/scissors/turned_mirror.h"

namespace bladecurve {
namespace {

constexpr double kRival = 0.25;  // ambiguity of edges that have one
constexpr const char* kWhereMirrored = "where the other one puts it";

// What is seen where the other one puts a blade, the other one not being seen where that puts it.
struct SeenAlone {
  bool outside = false;       // further out than the blade was
  bool beyond_pivot = false;  // the blades differ by more than the pivot accounts for
};

// Whether light clearly falls at an edge, going outwards, and no faint line of the ground was
// followed instead: no shadow's border does that, and what is seen further in is a line on the
// blade.
bool IsSurelyBorder(const LocatedEdge& edge, const LocatedEdge& further_in) {
  constexpr double kLeastHeight = 0.25;  // of the step further in
  return IsClear(edge) &&
         -TypicalContrast(edge) > kLeastHeight * std::abs(TypicalContrast(further_in));
}

// Whether `blade` is to be taken from where it was found. An edge that alone is seen where the
// other one puts it, further out, is the border: before it was a line on the blade, a bevel's,
// however clear. Not where the pivot may account for the difference, unless it is as sure there; a
// clear edge is then not left for a higher step either.
bool IsBetter(const std::optional<RelocatedBlade>& found,
              const LocatedBlade& blade,
              const SeenAlone& alone) {
  constexpr double kClearer = 0.5, kAlone = 0.6;  // ambiguity
  if (!found) return false;
  const LocatedEdge& edge = found->blade.edge;
  const bool sure = alone.beyond_pivot || TotalSigma(edge) <= TotalSigma(blade.edge);
  if (alone.outside && sure && edge.ambiguity <= kAlone) return true;
  return (alone.beyond_pivot || !IsClear(blade.edge)) && edge.ambiguity <= kClearer &&
         std::abs(TypicalContrast(edge)) > std::abs(TypicalContrast(blade.edge));
}

bool NoneMoved(const Blades& blades) {
  return blades.upper.moved.empty() && blades.lower.moved.empty();
}

// By how much edges of that asymmetry differ beyond what the pivot accounts for. px
double BeyondPivotPx(double asymmetry, const Pivot& pivot, const Blades& blades) {
  const double off_px = ShareInPx(asymmetry, pivot, blades);
  const double by_pivot_px = PartedByPivotPx(pivot, blades);
  return std::sqrt(std::max(0.0, off_px * off_px - by_pivot_px * by_pivot_px));
}

// A doubtful edge, where the other one, if clear, puts it, if that leaves less doubt; else, if some
// of it strays, along that one's mirror image. One that is just vague, without a rival, stays: a
// clearer line close by is a bevel's. Where it would mirror the other one only if it lay nearer to
// its rival, the border may lie between the two lines.
// `look(upper)`: where the other one puts that one.
template <typename Look>
void RelocateDoubtfulOne(const BladeView& view,
                         const Pivot& pivot,
                         const Look& look,
                         Blades* blades) {
  constexpr double kLess = 0.75;  // of the ambiguity before
  const bool upper = IsDoubtful(blades->upper.edge);
  const auto [doubtful, other] = OneOf(blades, upper);
  if (!IsDoubtful(doubtful.edge) || !IsClear(other.edge)) return;
  if (doubtful.edge.ambiguity < kRival) return;
  std::optional<RelocatedBlade> found = look(upper);
  const LocatedEdge& before = doubtful.edge;
  const bool is_clearer = found && found->blade.edge.ambiguity < kLess * before.ambiguity &&
                          found->blade.edge.common_sigma_px <= before.common_sigma_px;
  if (!is_clearer) {
    BorrowDoubtfulOne(view, pivot, blades);
    return;
  }
  const bool towards_rival = LiesInwards(doubtful, pivot) == (before.rival_px > 0);
  const double off_px = BeyondPivotPx(found->asymmetry, pivot, *blades);
  if (towards_rival) AddSigma(&found->blade.edge, off_px);
  Replace(*found, kWhereMirrored, &doubtful);
}

// Whether an edge is far off the smooth course of its most part.
bool Strays(const LocatedBlade& blade) {
  constexpr double kFar = 0.006;  // of the length
  const Kink kink = KinkOf(blade);
  return kink.off_px > kFar * kink.length_px;
}

// Edges that do not mirror each other: the one that is better seen where the other puts it, or, if
// what is seen there strays, its border as a whole. A clear edge is not left for where a doubtful
// one puts it. Else the doubtful one.
void RelocateClearerOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  const MirrorLine line = LineBetween(view, pivot, *blades);
  const std::optional<RelocatedBlade> upper = LookWhereMirrored({view, pivot, blades->lower, line});
  const std::optional<RelocatedBlade> lower = LookWhereMirrored({view, pivot, blades->upper, line});
  const bool beyond = DifferBeyondPivot(pivot, *blades);
  const auto is_better = [&](const auto& found, bool upper_one, bool alone) {
    const auto [blade, other] = OneOf(blades, upper_one);
    const bool is_vague = IsDoubtful(other.edge) || HardlyShowsBeside(other.edge, blade.edge);
    if (IsClear(blade.edge) && is_vague) return false;
    const bool outside = LiesInwards(blade, pivot);
    if (found && !outside && IsSurelyBorder(blade.edge, found->blade.edge)) return false;
    return IsBetter(found, blade, {alone && outside, beyond});
  };
  const bool upper_better = is_better(upper, true, !lower);
  const bool lower_better = is_better(lower, false, !upper);
  if (upper_better != lower_better) {
    const RelocatedBlade& found = upper_better ? *upper : *lower;
    if (Strays(found.blade)) BorrowInnerOne(view, line, pivot, blades);
    if (NoneMoved(*blades))
      Replace(found, kWhereMirrored, upper_better ? &blades->upper : &blades->lower);
    return;
  }
  if (!upper_better) BorrowInnerOne(view, line, pivot, blades);
  if (!NoneMoved(*blades)) return;
  RelocateDoubtfulOne(
      view, pivot, [&](bool upper_one) { return upper_one ? upper : lower; }, blades);
}

// One of two edges that pass the pivot alike but are unlike in shape, as those of hardly any blades
// are: where the other one puts it, if it is seen there and the two are alike then.
std::optional<RelocatedBlade> LookForShape(const BladeView& view,
                                           const Pivot& pivot,
                                           const Blades& blades,
                                           bool upper,
                                           double difference) {
  constexpr double kSearchPx = 5, kLeft = 0.4;  // of the difference
  Blades instead = blades;
  const auto [blade, other] = OneOf(&instead, upper);
  std::optional<RelocatedBlade> found =
      LookNearMirrored({view, pivot, other, LineBetween(view, pivot, blades)}, kSearchPx);
  if (!found || !AreAlike(found->asymmetry)) return std::nullopt;
  blade = found->blade;
  if (ShapeDifference(view, pivot, instead) > kLeft * difference) return std::nullopt;
  return found;
}

// Whether edges are unlike in shape, and if so, what can be done: the one that is seen where the
// other puts it is taken from there; if that holds of neither, or of both, the vaguer one is
// doubted by as much as they differ.
bool SettleShapes(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kUnlike = 0.006;  // of the length; rendered ones differ by up to 0.003
  const double difference = ShapeDifference(view, pivot, *blades);
  if (difference < kUnlike) return false;
  const auto upper = LookForShape(view, pivot, *blades, true, difference);
  const auto lower = LookForShape(view, pivot, *blades, false, difference);
  if (upper.has_value() != lower.has_value()) {
    Replace(upper ? *upper : *lower, kWhereMirrored, upper ? &blades->upper : &blades->lower);
    return true;
  }
  if (!BorrowDoubtfulOne(view, pivot, blades))
    DoubtVaguerOne(ShareInPx(difference, pivot, *blades), blades);
  return true;
}

// Of edges more unlike than any view makes them, of which one is clear and the other is not, that
// other one as clearly where the first puts it: it had been lost. The distal ends, seen better, say
// where the mirror is.
bool RelocateLostOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kAsHigh = 0.5;   // of the clear one's step
  constexpr double kAside = 0.025;  // of the length; the lost one's end was found beside its edge
  if (!MayHaveLostOne(view, pivot, *blades)) return false;
  const auto [lost, clear] = OneOf(blades, IsClear(blades->lower.edge));
  const MirrorLine line = LineBetweenEnds(view, pivot, *blades);
  const double length_px = (clear.end.point_px - pivot.point_px).norm();
  const auto found = LookNearMirrored({view, pivot, clear, line}, kAside * length_px);
  if (!found || !AreAlike(found->asymmetry) || !IsClear(found->blade.edge)) return false;
  if (std::abs(TypicalContrast(found->blade.edge)) <
      kAsHigh * std::abs(TypicalContrast(clear.edge)))
    return false;
  Replace(*found, kWhereMirrored, &lost);
  MarkAsAssumed(view, pivot, &lost);
  return true;
}

// An edge that was never located, where the other one, if clear, is mirrored on a line that is seen
// along all of it: whichever way the outline went, blades turn about the pivot.
bool RelocateTracedOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kSearchPx = 4;
  LocatedBlade& traced = blades->lower;
  const LocatedBlade& other = blades->upper;
  if (!traced.edge.traced || !IsClear(other.edge) || !AssumesMirror(view, pivot)) return false;
  if (pivot.screw && IsFaint(*pivot.screw)) return false;
  const auto line = FindTurnedMirror(view, other, LineBetween(view, pivot, *blades));
  if (!line) return false;
  const auto found = LookNearMirrored({view, pivot, other, *line}, kSearchPx);
  if (!found || !AreAlike(found->asymmetry)) return false;
  Replace(*found, "where the other one, mirrored, is seen along all of it", &traced);
  MarkAsAssumed(view, pivot, &traced);
  return true;
}

// Where a slanted view may part the edges as well: the one that has a rival and is far better seen
// where the other puts it, if that is not seen where this one puts it. What is seen further in is
// mostly a line on the blade: only a far higher step counts there, and none far in.
void RelocateFarClearerOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kClear = 0.25, kLess = 0.5;    // ambiguity; of that before
  constexpr double kOutside = 1, kFurtherIn = 3;  // times the step before
  constexpr double kLeft = 0.3;                   // of the difference
  if (pivot.screw && IsFaint(*pivot.screw)) return;
  const MirrorLine line = LineBetween(view, pivot, *blades);
  const auto upper = LookWhereMirrored({view, pivot, blades->lower, line});
  const auto lower = LookWhereMirrored({view, pivot, blades->upper, line});
  if (upper.has_value() == lower.has_value()) return;
  const RelocatedBlade& found = upper ? *upper : *lower;
  const auto [blade, other] = OneOf(blades, upper.has_value());
  const LocatedEdge &before = blade.edge, &after = found.blade.edge;
  if (before.ambiguity < kRival || IsDoubtful(other.edge)) return;
  if (after.ambiguity > std::min(kClear, kLess * before.ambiguity)) return;
  const bool outside = LiesInwards(blade, pivot);
  if (AreFarUnlike(pivot.asymmetry) && !outside) return;
  const double higher = outside ? kOutside : kFurtherIn;
  if (std::abs(TypicalContrast(after)) <= higher * std::abs(TypicalContrast(before))) return;
  const MirroredBladeSearch search{view, pivot, other, line};
  if (LeftOfDifference(search, found) > kLeft) return;
  ReplaceAssumed(search, found, kWhereMirrored, &blade);
}

// Edges that differ by more than a pivot that lies a little aside makes them.
void DoubtIfBeyondPivot(const Pivot& pivot, Blades* blades) {
  if (DifferBeyondPivot(pivot, *blades))
    DoubtVaguerOne(ShareInPx(std::abs(pivot.asymmetry), pivot, *blades), blades);
}

// Edges that pass the pivot alike but are unlike in shape, which no slant of the view makes them:
// either may be something else's border.
void DoubtUnlikeShapes(const Pivot& pivot, Blades* blades) {
  constexpr double kUnlike = 0.004;  // of the length; seen at a slant, the right ones keep to 0.003
  if (!(pivot.unlikeness >= kUnlike)) return;  // also if it cannot be told
  for (LocatedBlade* blade : {&blades->upper, &blades->lower})
    Doubt(&blade->edge, ShareInPx(pivot.unlikeness, pivot, *blades));
}

// Where a slanted view may part the edges as well. The upper edge is left only if it has a rival,
// and for what is seen: the lower one, mirrored, is as wrong as the slant. The lower one is not
// looked for: in photographs other lines lie where a slanted view would have it.
void RelocateInnerOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kDoubt = 0.5;  // of the way
  constexpr double kSeen = 0.6;   // ambiguity; cloth has lines of more
  const auto [inner, other] = InnerOne(pivot, blades);
  const MirrorLine line = LineBetween(view, pivot, *blades);
  if (&inner == &blades->lower) return BorrowInnerOne(view, line, pivot, blades);
  if (inner.edge.ambiguity < kRival) return;
  const MirroredBladeSearch search{view, pivot, other, line};
  std::optional<RelocatedBlade> found = LookWhereMirrored(search);
  if (!found || found->blade.edge.ambiguity > kSeen) return;
  Doubt(&found->blade.edge, kDoubt * WayPx(search));
  Replace(*found, kWhereMirrored, &inner);
}

// Whether a blade, found anew, mirrors the other by far better: in how they pass by the pivot and
// in shape. Hardly any line but the border does both.
bool MirrorsFarBetter(const MirroredBladeSearch& search,
                      const RelocatedBlade& found,
                      const Blades& blades) {
  constexpr double kLeft = 0.4;     // of the difference
  constexpr double kAlike = 0.004;  // of the length; seen at a slant, the right ones keep to 0.003
  if (!AreAlike(found.asymmetry)) return false;
  Blades instead = blades;
  OneOf(&instead, found.blade.on_left == blades.upper.on_left).blade = found.blade;
  const double unlike = ShapeDifference(search.view, search.pivot, instead);
  return unlike > 0 &&  // or nothing can be compared
         unlike < std::min(kAlike, kLeft * ShapeDifference(search.view, search.pivot, blades));
}

// A blade along its rival further out, however faint that is.
std::optional<RelocatedBlade> LookAlongRival(const MirroredBladeSearch& search,
                                             const LocatedBlade& blade) {
  if (blade.edge.rival_px <= 0) return std::nullopt;
  std::optional<LocatedEdge> edge = AlongRival(search.view, blade.edge, blade.on_left);
  if (!edge) return std::nullopt;
  return UnlessRefused([&] { return BladeWithEdge(search, *std::move(edge)); });
}

// The inner one of edges that differ, by no more than bevels are wide, where the blade's colour
// ends, or along its rival, if there it mirrors the other by far better. Where a slanted view may
// part them as well, not where it is far vaguer, as what hardly shows lies everywhere, nor from
// where the ground's colour ends.
void RelocateFurtherOut(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kWidestBevel = 0.05;            // of the length
  constexpr double kShortOf = 0.5, kDoubt = 0.25;  // of the way
  constexpr double kVaguer = 3;                    // times the standard uncertainty before
  if (pivot.screw && IsFaint(*pivot.screw)) return;
  if (std::abs(pivot.asymmetry) > kWidestBevel) return;
  const auto [inner, other] = InnerOne(pivot, blades);
  if (IsDoubtful(other.edge)) return;
  if (!KnowsMirror(view, pivot) && GroundEndsAt(view, inner.edge, other.edge, inner.on_left))
    return;
  const MirroredBladeSearch search{view, pivot, other, LineBetween(view, pivot, *blades)};
  const double sigma_px =
      std::hypot(TypicalSigma(inner.edge.points), SigmaWithoutRival(inner.edge));
  const auto is_better = [&](const RelocatedBlade& found) {
    return (KnowsMirror(view, pivot) || TotalSigma(found.blade.edge) < kVaguer * sigma_px) &&
           MirrorsFarBetter(search, found, *blades);
  };
  const auto if_better = [&](std::optional<RelocatedBlade> found) {
    return found && is_better(*found) ? std::move(found) : std::nullopt;
  };
  auto found = if_better(LookInColours(search, WayPx(search)));
  if (!found) found = if_better(LookAlongRival(search, inner));
  if (!found && DifferBeyondPivot(pivot, *blades)) {
    // Not as far as to the line that is doubted. So close, all that is seen mirrors the other one.
    found = if_better(LookInColours(search, kShortOf * WayPx(search)));
    if (found) AddSigma(&found->blade.edge, kDoubt * WayPx(search));
  }
  if (!found) return;
  Replace(*found, "further out, where it mirrors the other one", &inner);
  MarkAsAssumed(view, pivot, &inner);
}

void Relocate(const BladeView& view, const Pivot& pivot, Blades* blades) {
  if (pivot.bent) return;
  if (RelocateTracedOne(view, pivot, blades)) return;
  if (RelocateLostOne(view, pivot, blades)) return;
  if (!KnowsMirror(view, pivot)) {
    if (!AssumesMirror(view, pivot)) return;
    if (!AreSuspect(pivot.asymmetry)) {
      if (!BorrowDoubtfulOne(view, pivot, blades)) DoubtUnlikeShapes(pivot, blades);
      return;
    }
    // A slanted view may part them as well; but then nothing is seen where they would agree.
    if (RelocateShadowedOne(view, pivot, blades)) return;
    if (AreFarUnlike(pivot.asymmetry)) RelocateInnerOne(view, pivot, blades);
    if (NoneMoved(*blades)) RelocateFarClearerOne(view, pivot, blades);
    if (NoneMoved(*blades)) SettleInnerOne(view, pivot, blades);
    if (NoneMoved(*blades)) RelocateFurtherOut(view, pivot, blades);
    if (NoneMoved(*blades)) BorrowDoubtfulOne(view, pivot, blades);
    return;
  }
  if (RelocateShadowedOne(view, pivot, blades)) return;
  if (AreSuspect(pivot.asymmetry)) {
    if (LeaveBothShadows(view, pivot, blades)) return;
    RelocateClearerOne(view, pivot, blades);
    if (NoneMoved(*blades)) SettleInnerOne(view, pivot, blades);
    if (NoneMoved(*blades)) RelocateFurtherOut(view, pivot, blades);
    if (NoneMoved(*blades)) BorrowDoubtfulOne(view, pivot, blades);
    if (NoneMoved(*blades)) BorrowOuterOne(view, pivot, blades);
    if (NoneMoved(*blades)) DoubtIfBeyondPivot(pivot, blades);
  } else if (!SettleShapes(view, pivot, blades)) {
    const auto look = [&](bool upper) {
      const MirrorLine line = LineBetween(view, pivot, *blades);
      return LookWhereMirrored({view, pivot, OneOf(blades, upper).other, line});
    };
    RelocateDoubtfulOne(view, pivot, look, blades);
  }
}

}  // namespace

bool MayHaveLostOne(const BladeView& view, const Pivot& pivot, const Blades& blades) {
  return AssumesMirror(view, pivot) && LieInNoPlane(pivot.asymmetry) &&
         IsClear(blades.upper.edge) != IsClear(blades.lower.edge);
}

void RelocateUnlikeEdges(const BladeView& view, Pivot* pivot, Blades* blades) {
  const Blades blades_before = *blades;
  const Pivot pivot_before = *pivot;
  Relocate(view, *pivot, blades);
  CompareEdges(view.scale(), view.scene(), PairOf(blades->upper, blades->lower), pivot);
  if (!PassByPivot(pivot_before) || PassByPivot(*pivot)) return;
  *blades = blades_before;
  *pivot = pivot_before;
}

void DoubtMovedEdges(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kSigmas = 2;
  if (NoneMoved(*blades)) return;
  if (!KnowsMirror(view, pivot) || pivot.bent) return;
  const double asymmetry = AsymmetryOf(view, pivot, blades->upper, blades->lower);
  const double off_px = ShareInPx(std::abs(asymmetry), pivot, *blades);
  if (off_px < kSigmas * PartedByPivotPx(pivot, *blades)) return;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    if (!blade->moved.empty()) Doubt(&blade->edge, off_px);
  }
}

}  // namespace bladecurve
