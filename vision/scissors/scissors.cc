// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/scissors.h"

#include <optional>
#include <utility>

#include "vision/edge/edge_debug.h"
#include "vision/parallel.h"
#include "vision/pivot/head_search.h"
#include "vision/pivot/pivot_debug.h"
#include "vision/refused.h"
#include "vision/scissors/blade_view.h"
#include "vision/scissors/colour_shift.h"
#include "vision/scissors/confirmed_edge.h"
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/edge_pair.h"
#include "vision/scissors/edge_parting.h"
#include "vision/scissors/edge_relocation.h"
#include "vision/scissors/end_pair.h"
#include "vision/scissors/lost_end.h"
#include "vision/scissors/mirror_line.h"
#include "vision/scissors/unseen_bevel.h"

namespace bladecurve {
namespace {

Blades LocateAndTrim(const BladeView& view, StageLog* log) {
  BladeEdges edges = LocateBlades(view, log->plan());
  Blades blades{{true, std::move(edges.upper), {}, {}, {}},
                {false, std::move(edges.lower), {}, {}, {}},
                false};
  ParallelFor(2, [&](int blade) { TrimToFree(view, blade == 0 ? &blades.upper : &blades.lower); });
  FindLostEnds(view, &blades);
  log->Picture("edge-upper", [&] { return DrawEdge(view.grey(), blades.upper.edge); });
  log->Picture("edge-lower", [&] { return DrawEdge(view.grey(), blades.lower.edge); });
  log->Ran("edges", "full resolution along the blades only");
  return blades;
}

// What the edges and the look at the joint give, which need nothing of each other.
struct Parts {
  Blades blades;
  std::optional<Screw> at_joint;
};

Parts LocateParts(const BladeView& view, StageLog* log) {
  Parts parts;
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      parts.blades = LocateAndTrim(view, log);
    } else {
      parts.at_joint = LookAtJoint(view.grey(), view.scale(), view.scene());
    }
  });
  return parts;
}

Pivot LocatePivot(const BladeView& view,
                  const StoredHints& hints,
                  const Parts& parts,
                  StageLog* log) {
  const PivotSearch search{
      view.scene(), PairOf(parts.blades.upper, parts.blades.lower), hints.pivot_px, parts.at_joint};
  Pivot pivot = FindPivot(view.grey(), view.scale(), search);
  log->Picture("pivot", [&] { return DrawPivot(view.grey(), view.scene(), pivot); });
  log->Ran("pivot", pivot.source);
  return pivot;
}

// Edges that contradict each other or the pivot: one of them may have been taken elsewhere, where
// the view is known, or lost.
void Reconcile(const BladeView& view, Pivot* pivot, Blades* blades, StageLog* log) {
  CutUnlikeEnds(view, pivot, blades);
  if (!KnowsMirror(view, *pivot) && !MayHaveLostOne(view, *pivot, *blades))
    RefuseInconsistent(*pivot, *blades);
  RelocateUnlikeEdges(view, pivot, blades);
  RefuseInconsistent(*pivot, *blades);
  if (!blades->upper.moved.empty()) log->Ran("upper-edge-again", blades->upper.moved);
  if (!blades->lower.moved.empty()) log->Ran("lower-edge-again", blades->lower.moved);
}

// Where what was taken for the screw is none, the blades alone say where they turn.
void DropFalseHead(const BladeView& view, const Blades& blades, Pivot* pivot, StageLog* log) {
  if (!IsFalseHead(*pivot, view.scale(), blades)) return;
  *pivot = PivotByBlades(view.scale(), view.scene(), PairOf(blades.upper, blades.lower));
  RefuseInconsistent(*pivot, blades);
  log->Ran("pivot-again", "geometry: about the faint head the edges are no mirror images");
}

// What the parts say of each other: refusals, what is cut off, and doubts.
void CheckAgainstEachOther(const BladeView& view, const Pivot& pivot, Blades* blades) {
  RefuseContestedHead(pivot, view.scale());
  RefusePivotOffJoint(view.scene(), pivot);
  RefuseUnlikeEdges(pivot, view.scale(), *blades);
  RefuseUnconfirmedScene(view.scene(), view.scale(), pivot);
  CutWhereEdgesPart(view, pivot, blades);
  DoubtMovedEdges(view, pivot, blades);
  ConfirmMirroredEdges(view, pivot, blades);
  DoubtKinkedEdges(blades);
  DoubtUnlikeEdges(pivot, view.scale(), blades);
  DoubtSofterEdge(blades);
  DoubtUnseenBevel(view, blades);
  DoubtUnlikePrint(view.scale(), blades);
  DoubtLaterLook(view.scene(), pivot, blades);
}

void SettleEnds(const BladeView& view, const Pivot& pivot, Blades* blades) {
  AgreeOnEnds(view.scale(), pivot, blades);
  RefuseCutOffBlade(view.scale(), pivot, *blades, view.grey().size());
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    KeepFree(view.scene(), blade);
    PlaceEndOnCourse(blade);
  }
  RefuseClosed(pivot, *blades);
  KeepBeyondCrossing(blades);
  DoubtUnlikeEnds(pivot, view.scale(), blades);
}

Scissors LocateIn(const ScissorsView& seen, Scene scene, StageLog* log) {
  const BladeView view(seen.photo, seen.scale, scene);
  Parts parts = LocateParts(view, log);
  Pivot pivot = LocatePivot(view, seen.hints, parts, log);
  Reconcile(view, &pivot, &parts.blades, log);
  DropFalseHead(view, parts.blades, &pivot, log);
  CheckAgainstEachOther(view, pivot, &parts.blades);
  UndoLumaShift(view, log->plan(), &parts.blades);
  SettleEnds(view, pivot, &parts.blades);
  return {std::move(scene), std::move(pivot), std::move(parts.blades)};
}

}  // namespace

Scissors LocateScissors(const ScissorsView& view, SceneFinder* finder, StageLog* log) {
  std::optional<Refused> by_likeliest;
  for (int look = 1; look <= SceneFinder::kLooks; ++look) {
    try {
      if (look > 1) finder->LookAgain();
      return LocateIn(view, finder->Likeliest(), log);
    } catch (const RefusedForGood&) {
      if (by_likeliest) break;
      throw;
    } catch (const Refused& refusal) {
      if (!by_likeliest) by_likeliest = refusal;
      if (look < SceneFinder::kLooks) log->Ran("scene-again", refusal.what());
    }
  }
  throw Refused(*by_likeliest);
}

}  // namespace bladecurve
