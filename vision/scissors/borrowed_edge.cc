// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/borrowed_edge.h"

#include <algorithm>
#include <cmath>

#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirrored_blade.h"
#include "vision/scissors/mirrored_trace.h"

namespace bladecurve {
namespace {

// The other blade's edge, mirrored.
LocatedEdge Borrowed(const LocatedBlade& other, const MirroredTrace& trace, const Pivot& pivot) {
  LocatedEdge edge = other.edge;
  for (LocatedEdgePoint& p : edge.points) p = trace.line.Reflected(p);
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

}  // namespace

void BorrowInnerOne(const BladeView& view,
                    const MirrorLine& line,
                    const Pivot& pivot,
                    Blades* blades) {
  constexpr double kHalf = 0.5;
  if (pivot.screw && IsFaint(*pivot.screw)) return;
  if (!DifferBeyondPivot(pivot, *blades)) return;
  const auto [inner, other] = InnerOne(pivot, blades);
  if (IsDoubtful(other.edge)) return;
  const MirroredBladeSearch search{view, pivot, other, line};
  auto trace = FindMirroredTrace(view, inner, other, line, WayPx(search));
  if (!trace && KnowsMirror(view, pivot) && MayBeLineOfBevel(inner, other, pivot))
    trace.emplace(MirroredTrace{line, kHalf * WayPx(search)});
  if (!trace) return;
  const LocatedEdge edge = Borrowed(other, *trace, pivot);
  const auto found = UnlessRefused([&] { return BladeWithEdge(search, edge); });
  if (found) Replace(*found, "the other one mirrored, along a faint step in the light", &inner);
}

}  // namespace bladecurve
