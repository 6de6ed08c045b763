// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/pivot.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// From the pivot to the distal ends, px.
[[nodiscard]] double BladeLengthPx(const Pivot& pivot, const Blades& blades);

// By how much the pivot's uncertainty parts the edges, px: where it lies aside of the line between
// the blades, that adds to the distance at which one passes it and takes as much from the other's.
[[nodiscard]] double PartedByPivotPx(const Pivot& pivot, const Blades& blades);

// Throws Refused where edges and pivot cannot be those of flat scissors: kOutOfPlane for angled
// blades, kNotScissors for jaws that meet instead of crossing, kAmbiguousPivot where neither a
// screw nor the blades tell where they turn.
void RefuseInconsistent(const Pivot& pivot, const Blades& blades);

// Throws Refused{kClosed} where the distal ends lie on each other, or have passed each other: the
// blades are closed, or both edges are of one blade and its shadow.
void RefuseClosed(const Pivot& pivot, const Blades& blades);

// Whether the edges pass by it as far as those of usual scissors do; jaws' meet there.
[[nodiscard]] bool PassByPivot(const Pivot& pivot);

// Whether an edge by itself is in no doubt: no other border beside it, and known to a pixel; or in
// grave doubt. Between the two nothing is said.
[[nodiscard]] bool IsClear(const LocatedEdge& edge);
[[nodiscard]] bool IsDoubtful(const LocatedEdge& edge);

// Makes an edge ambiguous, and less certain by so much: it may lie that far off.
void Doubt(LocatedEdge* edge, double off_px);

// The same for the sake of its rival, which may be its border.
void DoubtForRival(LocatedEdge* edge, double off_px);

// Makes a line so far out of the blade the edge's rival.
void SetRival(LocatedEdge* edge, double rival_px);

// By how much the edges would pass the pivot more unequally, signed as their asymmetry, px, if this
// one's rival were its border.
[[nodiscard]] double ByRivalPx(const LocatedBlade& blade);

// Whether the head is rather a shadow or a facet: it is faint, and two edges, each clear by itself
// and seen from a known side, are no mirror images about it by far.
[[nodiscard]] bool IsFalseHead(const Pivot& pivot, const ScaleResult& scale, const Blades& blades);

// Throws Refused{kLowContrast} where the edges, seen from a known side and about a pivot that is
// seen, are no mirror images by far, and by more than the pivot's uncertainty accounts for: one of
// them is something else's border.
void RefuseUnlikeEdges(const Pivot& pivot, const ScaleResult& scale, const Blades& blades);

// Throws Refused{kAmbiguousPivot} where a faint head lies far from where the blades put the pivot,
// unless the edges, seen from a known side, mirror each other about it.
void RefuseContestedHead(const Pivot& pivot, const ScaleResult& scale);

// Throws Refused{kAmbiguousPivot} where a pivot that is not given lies off the joint, by more than
// it is uncertain: blades part on one side of it, shanks on the other.
void RefusePivotOffJoint(const Scene& scene, const Pivot& pivot);

// Throws Refused{kLowContrast} for a doubtful scene if no pivot that is seen, or given, confirms
// it: the edges mirror each other about it as far as the view is known, in shape as well, and a
// second look needs more than a faint head. Where none is seen the scene must be plainer: else
// Refused{kAmbiguousPivot}.
void RefuseUnconfirmedScene(const Scene& scene, const ScaleResult& scale, const Pivot& pivot);

// Blades mirror each other. Where the edges do not, the view may be oblique or either edge may lie
// elsewhere: both become less certain by a tenth of how unlike they pass the pivot. Where they
// would mirror each other if the other transition beside one of them were its border, that may well
// be so (a bright bevel on a bright ground): such an edge becomes ambiguous, and less certain by
// 0.6 of the way there.
void DoubtUnlikeEdges(const Pivot& pivot, Blades* blades);

// A cutting edge is ground as one smooth curve. Where a twentieth and more of what was located is
// off the curve that the rest follows, by 0.3 % of its length, half a pixel and more than is known
// of it, another line was followed part of the way: the edge becomes ambiguous, and less certain by
// twice as much. Throws Refused{kLowContrast} where the upper edge is off by 2 %.
void DoubtKinkedEdges(Blades* blades);

// Both edges lie about as far from the lens. One that looks softer than the other has another step
// close by, as that to a narrow bevel, and may lie as far off: it becomes less certain by 1.2 times
// as much as it is softer.
void DoubtSofterEdge(Blades* blades);

// Edges are as sharp as print at the same distance. What makes one look softer or sharper, light or
// a shadow beside it, moves it by about as much. Much sharper than print, it is in doubt: another
// step lies close by, as that of a narrow shadow does.
void DoubtUnlikePrint(const ScaleResult& scale, Blades* blades);

// What was found at a second look only may follow other lines than the blades' borders: its edges
// are less certain by a hundredth of the blades' length.
void DoubtLaterLook(const Scene& scene, const Pivot& pivot, Blades* blades);

// The distal ends of edges that pass although they are no mirror images: one of the edges is
// something else's border, or the view is oblique. Either may turn the angle by as much as they
// differ.
void DoubtUnlikeEnds(const Pivot& pivot, Blades* blades);

}  // namespace bladecurve
