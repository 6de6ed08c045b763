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
#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_pair.h"
#include "vision/scissors/edge_parting.h"
#include "vision/scissors/edge_relocation.h"
#include "vision/scissors/end_pair.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {
namespace {

Blades LocateAndTrim(const ScissorsView& view, const Scene& scene, StageLog* log) {
  BladeEdges edges = LocateBlades(view.photo, view.scale, scene, log->plan());
  if (log->wants_pictures()) {
    log->Picture("edge-upper", DrawEdge(view.photo.grey(), edges.upper));
    log->Picture("edge-lower", DrawEdge(view.photo.grey(), edges.lower));
  }
  Blades blades{{true, std::move(edges.upper), {}, {}, {}},
                {false, std::move(edges.lower), {}, {}, {}},
                false};
  TrimToFree(view.photo, scene, &blades.upper);
  TrimToFree(view.photo, scene, &blades.lower);
  log->Ran("edges", "full resolution along the blades only");
  return blades;
}

// What the edges and the look at the joint give, which need nothing of each other.
struct Parts {
  Blades blades;
  std::optional<Screw> at_joint;
};

Parts LocateParts(const ScissorsView& view, const Scene& scene, StageLog* log) {
  Parts parts;
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      parts.blades = LocateAndTrim(view, scene, log);
    } else if (!view.hints.pivot_px) {
      parts.at_joint = LookAtJoint(view.photo.grey(), view.scale, scene);
    }
  });
  return parts;
}

Pivot LocatePivot(const ScissorsView& view, const Scene& scene, const Parts& parts, StageLog* log) {
  const cv::Mat& grey = view.photo.grey();
  const PivotSearch search{
      scene, PairOf(parts.blades.upper, parts.blades.lower), view.hints.pivot_px, parts.at_joint};
  Pivot pivot = FindPivot(grey, view.scale, search);
  if (log->wants_pictures()) log->Picture("pivot", DrawPivot(grey, scene, pivot));
  log->Ran("pivot", pivot.source);
  return pivot;
}

// Edges that contradict each other or the pivot: one of them may have been taken elsewhere, where
// the view is known, or lost.
void Reconcile(const MirrorView& view, Pivot* pivot, Blades* blades, StageLog* log) {
  if (!KnowsMirror(view, *pivot) && !MayHaveLostOne(view, *pivot, *blades))
    RefuseInconsistent(*pivot, *blades);
  RelocateUnlikeEdges(view, pivot, blades);
  RefuseInconsistent(*pivot, *blades);
  if (!blades->upper.moved.empty()) log->Ran("upper-edge-again", blades->upper.moved);
  if (!blades->lower.moved.empty()) log->Ran("lower-edge-again", blades->lower.moved);
}

// Where what was taken for the screw is none, the blades alone say where they turn.
void DropFalseHead(const MirrorView& view, const Blades& blades, Pivot* pivot, StageLog* log) {
  if (!IsFalseHead(*pivot, view.scale, blades)) return;
  *pivot = PivotByBlades(view.scale, view.scene, PairOf(blades.upper, blades.lower));
  RefuseInconsistent(*pivot, blades);
  log->Ran("pivot-again", "geometry: about the faint head the edges are no mirror images");
}

// What the parts say of each other: refusals, what is cut off, and doubts.
void CheckAgainstEachOther(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  RefuseContestedHead(pivot, view.scale);
  RefuseUnlikeEdges(pivot, view.scale, *blades);
  RefuseUnconfirmedScene(view.scene, pivot);
  CutWhereEdgesPart(view, pivot, blades);
  DoubtKinkedEdges(blades);
  DoubtUnlikeEdges(pivot, blades);
  DoubtSofterEdge(blades);
  DoubtUnlikePrint(view.scale, blades);
  DoubtLaterLook(view.scene, pivot, blades);
}

void SettleEnds(const MirrorView& view, const Pivot& pivot, Blades* blades) {
  AgreeOnEnds(view.scale, pivot, blades);
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    KeepFree(view.scene, blade);
    PlaceEndOnCourse(blade);
  }
  KeepBeyondCrossing(blades);
  DoubtUnlikeEnds(pivot, blades);
}

Scissors LocateIn(const ScissorsView& view, Scene scene, StageLog* log) {
  Parts parts = LocateParts(view, scene, log);
  Pivot pivot = LocatePivot(view, scene, parts, log);
  const MirrorView mirror_view{view.photo, view.scale, scene};
  Reconcile(mirror_view, &pivot, &parts.blades, log);
  DropFalseHead(mirror_view, parts.blades, &pivot, log);
  CheckAgainstEachOther(mirror_view, pivot, &parts.blades);
  SettleEnds(mirror_view, pivot, &parts.blades);
  return {std::move(scene), std::move(pivot), std::move(parts.blades)};
}

}  // namespace

Scissors LocateScissors(const ScissorsView& view, SceneFinder* finder, StageLog* log) {
  std::optional<Refused> by_likeliest;
  for (int look = 1; look <= SceneFinder::kLooks; ++look) {
    try {
      if (look > 1) finder->LookAgain();
      return LocateIn(view, finder->Likeliest(), log);
    } catch (const Refused& refusal) {
      if (!by_likeliest) by_likeliest = refusal;
      if (look < SceneFinder::kLooks) log->Ran("scene-again", refusal.what());
    }
  }
  throw Refused(*by_likeliest);
}

}  // namespace bladecurve
