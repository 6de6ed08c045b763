// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_relocation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/image/robust_statistics.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_pair.h"
#include "vision/scissors/mirrored_trace.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kAssumedAmbiguity = 0.6;  // of an edge that is as symmetry has it: it is doubted

// A blade located anew.
struct Relocated {
  LocatedBlade blade;
  double asymmetry = 0;
};

double AsymmetryOf(const MirrorView& view,
                   const Pivot& pivot,
                   const LocatedBlade& a,
                   const LocatedBlade& b) {
  return EdgeAsymmetry(SeenFromAbove(view.scale, PairOf(a, b), pivot.point_px), pivot.point_px);
}

// Whether an edge lies on the side of its blade that faces the gap, no deeper than where a shadow
// widened what scene finding took for the blade.
bool FacesGap(const Scene& scene, const LocatedBlade& blade) {
  constexpr double kWidest = 0.5;      // such a shadow, of that width
  constexpr std::size_t kEnough = 50;  // places along the edge
  const SceneBlade& seen = blade.on_left ? scene.left : scene.right;
  std::vector<double> inwards_px;
  for (std::size_t i = 0; i < blade.used.size(); i += 1 + blade.used.size() / kEnough) {
    const LocatedEdgePoint& p = blade.used[i];
    const auto off = [&](const Vector2d& q) { return (q - p.trend_px).squaredNorm(); };
    const auto nearest = std::min_element(
        seen.inner_px.begin(), seen.inner_px.end(), [&](const Vector2d& a, const Vector2d& b) {
          return off(a) < off(b);
        });
    inwards_px.push_back((*nearest - p.trend_px).dot(p.normal));
  }
  return Median(std::move(inwards_px)) < kWidest * seen.width_px;
}

// The look for one blade where the other's mirror image lies.
struct Mirroring {
  const MirrorView& view;
  const Pivot& pivot;
  const LocatedBlade& other;  // whose mirror image it is
  MirrorLine line;

  // How far off it the blade was found.
  [[nodiscard]] double WayPx() const {
    return std::abs(pivot.asymmetry) * (other.end.point_px - pivot.point_px).norm();
  }

  [[nodiscard]] EdgeGuess GuessWithin(double search_px) const {
    EdgeGuess guess;
    for (const LocatedEdgePoint& p : other.edge.points) {
      if (p.inlier) guess.path_px.push_back(line.Reflected(p.trend_px));
    }
    guess.blade_on_left = !other.on_left;
    guess.search_px = search_px;
    return guess;
  }

  // At least so far aside, and further where the way is long.
  [[nodiscard]] double Widened(double search_px) const {
    constexpr double kOfWay = 0.35;
    return std::max(search_px, kOfWay * WayPx());
  }

  // Of the difference between the two, what is left.
  [[nodiscard]] double LeftBy(const Relocated& found) const {
    return std::abs(found.asymmetry) / std::abs(pivot.asymmetry);
  }

  // The blade with that edge. Throws Refused where too little of it is free.
  [[nodiscard]] Relocated WithEdge(LocatedEdge edge) const {
    Relocated found;
    found.blade.on_left = !other.on_left;
    found.blade.edge = std::move(edge);
    TrimToFree(view.photo, view.scene, &found.blade);
    found.asymmetry = AsymmetryOf(view, pivot, found.blade, other);
    return found;
  }

  // What is seen there.
  [[nodiscard]] std::optional<Relocated> LookWithin(double search_px) const {
    return IfItFacesGap([&] {
      return LocateBladeAlong(view.photo, view.scale, view.scene, GuessWithin(search_px));
    });
  }

  // The place where a shadow begins.
  [[nodiscard]] std::optional<Relocated> LookInShadow(double search_px) const {
    std::optional<LocatedEdge> edge =
        LocateBladeInShadow(view.photo, view.scale, view.scene, GuessWithin(Widened(search_px)));
    if (!edge) return std::nullopt;
    return IfItFacesGap([&] { return *std::move(edge); });
  }

  // The other side of the blade, or a line within it, may lie there too.
  template <typename Look>
  [[nodiscard]] std::optional<Relocated> IfItFacesGap(const Look& look) const {
    auto found = UnlessRefused([&] { return WithEdge(look()); });
    return found && FacesGap(view.scene, found->blade) ? std::move(found) : std::nullopt;
  }
};

// The blade where the other one puts it, if it is seen there and the two are alike then.
std::optional<Relocated> LookWhereMirrored(const Mirroring& mirroring) {
  constexpr double kNearest = 5, kShortOf = 0.6;   // px; of the way to where it was
  constexpr double kMuchLess = 0.5, kSame = 0.85;  // of the difference before, where there is one
  const bool suspect = AreSuspect(mirroring.pivot.asymmetry);
  std::optional<Relocated> found = mirroring.LookWithin(mirroring.Widened(kNearest));
  if (suspect && found && mirroring.LeftBy(*found) > kSame)  // the line that is doubted
    found = mirroring.LookWithin(kShortOf * mirroring.WayPx());
  if (!found || (suspect && mirroring.LeftBy(*found) >= kMuchLess)) return std::nullopt;
  return AreAlike(found->asymmetry) ? found : std::nullopt;
}

void Replace(const Relocated& found, const char* where, LocatedBlade* blade) {
  *blade = found.blade;
  blade->moved = where;
}

// An edge that was found by symmetry, unless that is known to hold.
void MarkAsAssumed(const MirrorView& view, const Pivot& pivot, LocatedBlade* blade) {
  if (!KnowsMirror(view, pivot))
    blade->edge.ambiguity = std::max(blade->edge.ambiguity, kAssumedAmbiguity);
}

// The upper blade or the lower one, and the other.
struct Chosen {
  LocatedBlade& blade;
  const LocatedBlade& other;
};

Chosen OneOf(Blades* blades, bool upper) {
  return upper ? Chosen{blades->upper, blades->lower} : Chosen{blades->lower, blades->upper};
}

constexpr const char* kWhereMirrored = "where the other one puts it";

// Whether it is the other blade's mirror image that lies further out.
bool LiesInwards(const LocatedBlade& blade, const Pivot& pivot) {
  return blade.on_left ? pivot.asymmetry < 0 : pivot.asymmetry > 0;
}

Chosen InnerOne(const Pivot& pivot, Blades* blades) {
  return OneOf(blades, LiesInwards(blades->upper, pivot));
}

// A share of the blades' length, px.
double InPx(double share, const Pivot& pivot, const Blades& blades) {
  return share * (blades.upper.end.point_px - pivot.point_px).norm();
}

// By more than a pivot that lies a little aside makes them.
bool DifferBeyondPivot(const Pivot& pivot, const Blades& blades) {
  constexpr double kSigmas = 3;
  return InPx(std::abs(pivot.asymmetry), pivot, blades) > kSigmas * 2 * pivot.SigmaPx();
}

// What is seen where the other one puts a blade, the other one not being seen where that puts it.
struct SeenAlone {
  bool outside = false;       // further out than the blade was
  bool beyond_pivot = false;  // the blades differ by more than the pivot accounts for
};

// Whether `blade` is to be taken from where it was found. An edge that alone is seen where the
// other one puts it, further out, is the border: before it was a line on the blade, a bevel's,
// however clear. Not where the pivot may account for the difference, unless it is as sure there.
bool IsBetter(const std::optional<Relocated>& found,
              const LocatedBlade& blade,
              const SeenAlone& alone) {
  constexpr double kClearer = 0.5, kAlone = 0.6;  // ambiguity
  if (!found) return false;
  const LocatedEdge& edge = found->blade.edge;
  const bool sure = alone.beyond_pivot || TotalSigma(edge) <= TotalSigma(blade.edge);
  if (alone.outside && sure && edge.ambiguity <= kAlone) return true;
  return edge.ambiguity <= kClearer &&
         std::abs(TypicalContrast(edge)) > std::abs(TypicalContrast(blade.edge));
}

// The other blade's edge, mirrored, for want of a better one: as good as that, the pivot and the
// trace are, and marked as doubtful.
LocatedEdge Borrowed(const LocatedBlade& other, const MirroredTrace& trace, const Pivot& pivot) {
  LocatedEdge edge = other.edge;
  for (LocatedEdgePoint& p : edge.points) p = trace.line.Reflected(p);
  edge.common_sigma_px = std::hypot(edge.common_sigma_px, trace.sigma_px, pivot.SigmaPx());
  edge.ambiguity = kAssumedAmbiguity;
  edge.rival_px = 0;
  edge.rival_path_px.clear();
  return edge;
}

// Of edges that do not mirror each other, neither being seen where the other puts it, the inner one
// from where the other's mirror image as a whole is seen, too faintly to be located by itself.
// About a head that may be none, the edges say nothing of each other.
void TraceInnerOne(const MirrorView& view,
                   const MirrorLine& line,
                   const Pivot& pivot,
                   Blades* blades) {
  if (pivot.screw && IsFaint(*pivot.screw)) return;
  if (!DifferBeyondPivot(pivot, *blades)) return;
  const auto [inner, other] = InnerOne(pivot, blades);
  const Mirroring mirroring{view, pivot, other, line};
  const auto trace = FindMirroredTrace(view, inner, other, line, mirroring.WayPx());
  if (!trace) return;
  const LocatedEdge edge = Borrowed(other, *trace, pivot);
  const auto found = UnlessRefused([&] { return mirroring.WithEdge(edge); });
  if (found) Replace(*found, "the other one mirrored, along a faint step in the light", &inner);
}

// Edges that do not mirror each other: the one that is better seen where the other puts it.
void RelocateClearerOne(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  const MirrorLine line = LineBetween(view, pivot, *blades);
  const std::optional<Relocated> upper = LookWhereMirrored({view, pivot, blades->lower, line});
  const std::optional<Relocated> lower = LookWhereMirrored({view, pivot, blades->upper, line});
  const bool beyond = DifferBeyondPivot(pivot, *blades);
  const bool upper_better =
      IsBetter(upper, blades->upper, {!lower && LiesInwards(blades->upper, pivot), beyond});
  const bool lower_better =
      IsBetter(lower, blades->lower, {!upper && LiesInwards(blades->lower, pivot), beyond});
  if (upper_better && lower_better) return;
  if (upper_better) {
    Replace(*upper, kWhereMirrored, &blades->upper);
  } else if (lower_better) {
    Replace(*lower, kWhereMirrored, &blades->lower);
  } else {
    TraceInnerOne(view, line, pivot, blades);
  }
}

// Edges that mirror each other but for a little, of which the outer one may be a shadow's border:
// the place where a shadow begins, where the other one puts it, if that accounts for the
// difference.
bool RelocateShadowedOne(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kLeastPx = 1.5;       // a thinner band cannot be told from blur
  constexpr double kLeastShare = 0.004;  // of the length; blades are ground alike to less
  constexpr double kLeft = 0.3, kLeftByDoubtful = 0.5;  // of the difference
  constexpr double kNearest = 1;                        // px
  constexpr double kSeen = 0.65;  // ambiguity; what texture shows is seen less
  const auto [outer, other] = OneOf(blades, !LiesInwards(blades->upper, pivot));
  const Mirroring mirroring{view, pivot, other, LineBetween(view, pivot, *blades)};
  if (std::abs(pivot.asymmetry) < kLeastShare || mirroring.WayPx() < kLeastPx) return false;
  const std::optional<Relocated> found = mirroring.LookInShadow(kNearest);
  if (!found || found->blade.edge.ambiguity > kSeen || !AreAlike(found->asymmetry)) return false;
  if (mirroring.LeftBy(*found) > (IsDoubtful(outer.edge) ? kLeftByDoubtful : kLeft)) return false;
  Replace(*found, "inside a shadow, where the other one puts it", &outer);
  MarkAsAssumed(view, pivot, &outer);
  return true;
}

// A doubtful edge, where the other one, if clear, puts it, if that leaves less doubt.
void RelocateDoubtfulOne(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kLess = 0.75;  // of the ambiguity before
  const auto [doubtful, other] = OneOf(blades, IsDoubtful(blades->upper.edge));
  if (!IsDoubtful(doubtful.edge) || !IsClear(other.edge)) return;
  const std::optional<Relocated> found =
      LookWhereMirrored({view, pivot, other, LineBetween(view, pivot, *blades)});
  if (!found) return;
  const LocatedEdge &before = doubtful.edge, &after = found->blade.edge;
  if (after.ambiguity < kLess * before.ambiguity && after.common_sigma_px <= before.common_sigma_px)
    Replace(*found, kWhereMirrored, &doubtful);
}

// One of two edges that pass the pivot alike but are unlike in shape, as those of hardly any blades
// are: where the other one puts it, if it is seen there and the two are alike then.
std::optional<Relocated> LookForShape(const MirrorView& view,
                                      const Pivot& pivot,
                                      const Blades& blades,
                                      bool upper,
                                      double difference) {
  constexpr double kSearchPx = 5, kLeft = 0.4;  // of the difference
  Blades instead = blades;
  const auto [blade, other] = OneOf(&instead, upper);
  std::optional<Relocated> found =
      Mirroring{view, pivot, other, LineBetween(view, pivot, blades)}.LookWithin(kSearchPx);
  if (!found || !AreAlike(found->asymmetry)) return std::nullopt;
  blade = found->blade;
  if (ShapeDifference(view, pivot, instead) > kLeft * difference) return std::nullopt;
  return found;
}

void DoubtVaguerOne(double off_px, Blades* blades) {
  const bool upper_vaguer = TotalSigma(blades->upper.edge) > TotalSigma(blades->lower.edge);
  Doubt(&OneOf(blades, upper_vaguer).blade.edge, off_px);
}

// Whether edges are unlike in shape, and if so, what can be done: the one that is seen where the
// other puts it is taken from there; if that holds of neither, or of both, the vaguer one is
// doubted by as much as they differ.
bool SettleShapes(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kUnlike = 0.006;  // of the length; rendered ones differ by up to 0.003
  const double difference = ShapeDifference(view, pivot, *blades);
  if (difference < kUnlike) return false;
  const auto upper = LookForShape(view, pivot, *blades, true, difference);
  const auto lower = LookForShape(view, pivot, *blades, false, difference);
  if (upper.has_value() != lower.has_value()) {
    Replace(upper ? *upper : *lower, kWhereMirrored, upper ? &blades->upper : &blades->lower);
    return true;
  }
  DoubtVaguerOne(InPx(difference, pivot, *blades), blades);
  return true;
}

// The blade along the inner side of a band beside its edge that may be a shadow, if it is seen.
std::optional<LocatedBlade> WithinBand(const MirrorView& view, const LocatedBlade& blade) {
  std::optional<LocatedEdge> edge =
      LocateBladeWithinBand(view.photo, view.scale, view.scene, blade.edge, blade.on_left);
  if (!edge) return std::nullopt;
  return UnlessRefused([&] {
    LocatedBlade within = blade;
    within.edge = *std::move(edge);
    TrimToFree(view.photo, view.scene, &within);
    return within;
  });
}

// A lamp behind the blades lays hard shadows beside both edges. Their borders mirror each other
// less well than the edges within do.
bool LeaveBothShadows(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kLeft = 0.5;  // of the difference
  const std::optional<LocatedBlade> upper = WithinBand(view, blades->upper);
  const std::optional<LocatedBlade> lower = upper ? WithinBand(view, blades->lower) : std::nullopt;
  if (!lower) return false;
  const double asymmetry = AsymmetryOf(view, pivot, *upper, *lower);
  if (std::abs(asymmetry) > kLeft * std::abs(pivot.asymmetry)) return false;
  blades->upper = *upper;
  blades->lower = *lower;
  blades->upper.moved = blades->lower.moved = "to the inner sides of the bands beside both";
  return true;
}

// Of edges more unlike than any view makes them, of which one is clear and the other is not, that
// other one as clearly where the first puts it: it had been lost. The distal ends, seen better, say
// where the mirror is.
bool RelocateLostOne(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kAsHigh = 0.5;   // of the clear one's step
  constexpr double kAside = 0.025;  // of the length; the lost one's end was found beside its edge
  if (!MayHaveLostOne(view, pivot, *blades)) return false;
  const auto [lost, clear] = OneOf(blades, IsClear(blades->lower.edge));
  const MirrorLine line = LineBetweenEnds(view, pivot, *blades);
  const double length_px = (clear.end.point_px - pivot.point_px).norm();
  const auto found = Mirroring{view, pivot, clear, line}.LookWithin(kAside * length_px);
  if (!found || !AreAlike(found->asymmetry) || !IsClear(found->blade.edge)) return false;
  if (std::abs(TypicalContrast(found->blade.edge)) <
      kAsHigh * std::abs(TypicalContrast(clear.edge)))
    return false;
  Replace(*found, kWhereMirrored, &lost);
  MarkAsAssumed(view, pivot, &lost);
  return true;
}

// Edges that differ by more than a pivot that lies a little aside makes them.
void DoubtIfBeyondPivot(const Pivot& pivot, Blades* blades) {
  if (DifferBeyondPivot(pivot, *blades))
    DoubtVaguerOne(InPx(std::abs(pivot.asymmetry), pivot, *blades), blades);
}

void Relocate(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  if (pivot.bent) return;
  if (RelocateLostOne(view, pivot, blades)) return;
  if (!KnowsMirror(view, pivot)) {
    // A slanted view may part them as well; but then nothing is seen where they would agree. What
    // is told of the upper edge must be seen: the other one, mirrored, is as wrong as the slant.
    if (!AssumesMirror(view, pivot) || !AreFarUnlike(pivot.asymmetry)) return;
    if (RelocateShadowedOne(view, pivot, blades)) return;
    const LocatedBlade& inner = InnerOne(pivot, blades).blade;
    if (&inner == &blades->lower && !IsClear(inner.edge))
      TraceInnerOne(view, LineBetween(view, pivot, *blades), pivot, blades);
    return;
  }
  if (RelocateShadowedOne(view, pivot, blades)) return;
  if (AreSuspect(pivot.asymmetry)) {
    if (LeaveBothShadows(view, pivot, blades)) return;
    RelocateClearerOne(view, pivot, blades);
    const bool none_moved = blades->upper.moved.empty() && blades->lower.moved.empty();
    if (none_moved) DoubtIfBeyondPivot(pivot, blades);
  } else if (!SettleShapes(view, pivot, blades)) {
    RelocateDoubtfulOne(view, pivot, blades);
  }
}

}  // namespace

bool MayHaveLostOne(const MirrorView& view, const Pivot& pivot, const Blades& blades) {
  return AssumesMirror(view, pivot) && LieInNoPlane(pivot.asymmetry) &&
         IsClear(blades.upper.edge) != IsClear(blades.lower.edge);
}

void RelocateUnlikeEdges(const MirrorView& view, Pivot* pivot, Blades* blades) {
  const Blades blades_before = *blades;
  const Pivot pivot_before = *pivot;
  Relocate(view, *pivot, blades);
  CompareEdges(view.scale, view.scene, PairOf(blades->upper, blades->lower), pivot);
  if (!PassByPivot(pivot_before) || PassByPivot(*pivot)) return;
  *blades = blades_before;
  *pivot = pivot_before;
}

}  // namespace bladecurve
