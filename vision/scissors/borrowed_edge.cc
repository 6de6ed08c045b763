// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/borrowed_edge.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirrored_blade.h"
#include "vision/scissors/mirrored_trace.h"
#include "vision/scissors/occluding_border.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The other blade's edge, mirrored.
LocatedEdge Borrowed(const LocatedBlade& other, const MirroredTrace& trace, const Pivot& pivot) {
  LocatedEdge edge = other.edge;
  edge.points = trace.line.Reflected(std::move(edge.points));
  edge.common_sigma_px = std::hypot(edge.common_sigma_px, trace.sigma_px, pivot.SigmaPx());
  edge.ambiguity = kAssumedAmbiguity;
  edge.rival_px = edge.rival_sigma_px = 0;
  edge.rival_path_px.clear();
  return edge;
}

// Whether the inner edge may be the line of a bevel that mirrors the ground without a trace, where
// one of two clear edges must be wrong: of blades brighter than the ground the outer one is no
// shadow's border.
bool MayBeLineOfBevel(const LocatedBlade& inner, const LocatedBlade& outer, const Pivot& pivot) {
  constexpr double kBrighter = -0.1;  // contrast
  return AreUnlike(pivot.asymmetry) && IsClear(inner.edge) && IsClear(outer.edge) &&
         std::max(TypicalContrast(inner.edge), TypicalContrast(outer.edge)) < kBrighter;
}

// The straight course through two places of a gap, a third of it apart or more, that as many others
// keep to as to any other.
GapCourse CommonestCourse(const EdgeGap& gap, double within_mm) {
  constexpr std::size_t kEnough = 40;  // places that are tried
  const std::size_t count = gap.along.size(), stride = 1 + count / kEnough;
  std::size_t most = 0;
  GapCourse commonest;
  for (std::size_t i = 0; i < count; i += stride) {
    for (std::size_t j = i + 1 + count / 3; j < count; j += stride) {
      const double turn = (gap.apart[j] - gap.apart[i]) / (gap.along[j] - gap.along[i]);
      const GapCourse course{0, 1, {gap.apart[i] - turn * gap.along[i], turn, 0}};
      std::size_t agree = 0;
      for (std::size_t k = 0; k < count; ++k)
        if (std::abs(gap.apart[k] - course.At(gap.along[k])) < within_mm) ++agree;
      if (agree > most) most = agree, commonest = course;
    }
  }
  return commonest;
}

// The line about which the longest part of an edge is the other's mirror image, if so much of it is
// and of the rest enough clearly lies within the blade: outside of its edge nothing is its line.
std::optional<MirrorLine> LineOfMost(const MirrorLine& line,
                                     const LocatedBlade& blade,
                                     const LocatedBlade& other) {
  constexpr double kUnlike = 0.005;            // of the length
  constexpr double kMost = 0.4, kRest = 0.15;  // of the places
  const EdgeGap gap = GapFromMirrored(line, blade, other);
  if (gap.along.empty()) return std::nullopt;
  const double length_mm = gap.along.back(), within_mm = kGroundAlike * length_mm;
  const GapCourse commonest = CommonestCourse(gap, within_mm);
  const auto agrees = [&](std::size_t i) {
    return std::abs(gap.apart[i] - commonest.At(gap.along[i])) < within_mm;
  };
  GapCourse course;
  course.Fit(gap, 2, agrees);
  const Vector2d end = line.map.PlaneFromImage(blade.used.back().trend_px) - line.pivot;
  const double inwards = std::copysign(1.0, Cross(line.direction, end));
  std::size_t agreeing = 0, astray = 0;
  for (std::size_t i = 0; i < gap.along.size(); ++i) {
    if (agrees(i)) ++agreeing;
    if (inwards * (gap.apart[i] - course.At(gap.along[i])) > kUnlike * length_mm) ++astray;
  }
  const auto places = static_cast<double>(gap.along.size());
  if (static_cast<double>(agreeing) < kMost * places ||
      static_cast<double>(astray) < kRest * places || AreUnlike(course.powers[0] / length_mm))
    return std::nullopt;
  return line.MovedBy(course);
}

// Whether another line than the blade's border may have been followed along some of an edge.
bool MayStray(const LocatedBlade& blade) {
  return IsDoubtful(blade.edge) || IsKinked(KinkOf(blade), blade.edge);
}

// About a head that may be none edges say nothing of each other, nor does one that is in doubt.
bool MayMirror(const LocatedBlade& other, const Pivot& pivot) {
  return !(pivot.screw && IsFaint(*pivot.screw)) && !IsDoubtful(other.edge);
}

// The other blade's mirror image where it is seen beyond `inner`. What hardly shows itself puts
// nothing where a clear edge is to be left for it.
std::optional<MirroredTrace> TraceBeyond(const MirroredBladeSearch& search,
                                         const LocatedBlade& inner) {
  const auto& [view, pivot, other, line] = search;
  if (IsClear(inner.edge) && HardlyShowsBeside(other.edge, inner.edge)) return std::nullopt;
  return FindMirroredTrace(view, inner, other, line, WayPx(search));
}

// How far the trace typically lies from an edge, of the length.
double ShareApart(const MirroredTrace& trace,
                  const LocatedBlade& blade,
                  const LocatedBlade& other) {
  const EdgeGap gap = GapFromMirrored(trace.line, blade, other);
  return gap.along.empty() ? 0 : MedianAbsolute(gap.apart) / gap.along.back();
}

}  // namespace

bool BorrowDoubtfulOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kSure = 0.2;  // ambiguity
  if (pivot.screw && IsFaint(*pivot.screw)) return false;
  const bool upper = MayStray(blades->upper);
  const auto [doubtful, other] = OneOf(blades, upper);
  if (upper == MayStray(blades->lower) || !IsClear(other.edge) || other.edge.ambiguity > kSure)
    return false;
  const auto line = LineOfMost(LineBetween(view, pivot, *blades), doubtful, other);
  if (!line) return false;
  const double sigma_px = ShareInPx(kGroundAlike, pivot, *blades);
  const LocatedEdge edge = Borrowed(other, {*line, sigma_px}, pivot);
  const auto found = UnlessRefused([&] {
    return BladeWithEdge({view, pivot, other, *line}, edge);
  });
  if (!found) return false;
  Replace(*found, "the other one mirrored, on which most of it lies", &doubtful);
  return true;
}

void BorrowInnerOne(const BladeView& view,
                    const MirrorLine& line,
                    const Pivot& pivot,
                    Blades* blades) {
  constexpr double kShare = 0.5;  // of the difference, standard
  const auto [inner, other] = InnerOne(pivot, blades);
  if (!MayMirror(other, pivot) || !DifferBeyondPivot(pivot, *blades)) return;
  const bool knows_mirror = KnowsMirror(view, pivot);
  if (IsClear(inner.edge) && (!knows_mirror || HasBevelWithin(inner.edge))) return;
  const MirroredBladeSearch search{view, pivot, other, line};
  auto trace = TraceBeyond(search, inner);
  if (!trace && knows_mirror && MayBeLineOfBevel(inner, other, pivot))
    trace.emplace(MirroredTrace{line, kShare * WayPx(search)});
  if (!trace) return;
  const LocatedEdge edge = Borrowed(other, *trace, pivot);
  if (IsSeenInBand(OcclusionUpTo(view, edge.points, inner.used, other.used))) return;
  const auto found = UnlessRefused([&] { return BladeWithEdge(search, edge); });
  if (found) Replace(*found, "the other one mirrored, along a faint step in the light", &inner);
}

void BorrowOuterOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kDoubt = 0.25;          // of the way, standard
  constexpr double kAlikeInShape = 0.003;  // of the length; blades bent to one side are not
  const auto [outer, inner] = OneOf(blades, !LiesInwards(blades->upper, pivot));
  if (!MayMirror(inner, pivot) || !DifferBeyondPivot(pivot, *blades)) return;
  const bool may_be_shadows = AreFarUnlike(pivot.asymmetry) && TypicalContrast(outer.edge) > 0 &&
                              pivot.unlikeness < kAlikeInShape;
  if (!may_be_shadows) return;
  const MirrorLine line = LineBetween(view, pivot, *blades);
  const std::vector<LocatedEdgePoint> beyond_inner = line.Reflected(outer.used);
  if (!IsSeenInBand(OcclusionUpTo(view, beyond_inner, inner.used, outer.used))) return;
  const MirroredBladeSearch search{view, pivot, inner, line};
  const LocatedEdge edge = Borrowed(inner, {line, kDoubt * WayPx(search)}, pivot);
  const auto found = UnlessRefused([&] { return BladeWithEdge(search, edge); });
  if (found) Replace(*found, "the other one mirrored, as that hides nothing further out", &outer);
}

void SettleInnerOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kWidestBevel = 0.06;  // of the length
  constexpr double kDoubt = 0.5;         // of the way
  constexpr double kSeen = 0.6;          // ambiguity
  constexpr const char* kWhere = "up to where it hides the other one";
  const auto [inner, other] = InnerOne(pivot, blades);
  if (!MayMirror(other, pivot) || std::abs(pivot.asymmetry) > kWidestBevel) return;
  const MirroredBladeSearch search{view, pivot, other, LineBetween(view, pivot, *blades)};
  const auto trace = TraceBeyond(search, inner);
  const LocatedEdge border = Borrowed(other, trace.value_or(MirroredTrace{search.line}), pivot);
  const Occlusion occlusion = OcclusionUpTo(view, border.points, inner.used, other.used);
  if (occlusion != Occlusion::kHidden) {
    if (trace && occlusion == Occlusion::kUntold)
      Doubt(&inner.edge, kDoubt * ShareInPx(ShareApart(*trace, inner, other), pivot, *blades));
    return;
  }
  const auto seen = LookWhereMirrored(search);
  if (seen && seen->blade.edge.ambiguity <= kSeen &&
      OcclusionUpTo(view, seen->blade.used, inner.used, other.used) == Occlusion::kHidden) {
    Replace(*seen, kWhere, &inner);
    return MarkAsAssumed(view, pivot, &inner);
  }
  if (!trace) return;
  const auto found = UnlessRefused([&] { return BladeWithEdge(search, border); });
  if (found) Replace(*found, kWhere, &inner);
}

}  // namespace bladecurve
