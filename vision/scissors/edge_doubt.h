// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/pivot.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// Whether an edge by itself is in no doubt: no other border beside it, and known to a pixel; or in
// grave doubt. Between the two nothing is said.
[[nodiscard]] bool IsClear(const LocatedEdge& edge);
[[nodiscard]] bool IsDoubtful(const LocatedEdge& edge);

// Whether a bevel is seen within an edge, by its line: then the edge is no bevel's line itself.
[[nodiscard]] bool HasBevelWithin(const LocatedEdge& edge);

// Whether light steps by so little at an edge, compared with the other one, that it says little of
// where that is.
[[nodiscard]] bool HardlyShowsBeside(const LocatedEdge& edge, const LocatedEdge& other);

// Makes an edge less certain by that much, standard, for reasons of its own.
void AddSigma(LocatedEdge* edge, double off_px);

// Makes an edge ambiguous, and less certain by so much: it may lie that far off.
void Doubt(LocatedEdge* edge, double off_px);

// The same for the sake of its rival, which may be its border.
void DoubtForRival(LocatedEdge* edge, double off_px);

// What an edge's common uncertainty is but for its rival.
[[nodiscard]] double SigmaWithoutRival(const LocatedEdge& edge);

// Makes an edge as certain as if it had no rival.
void DropRival(LocatedEdge* edge);

// What a wider look saw beside the same line is in doubt although a narrower one does not see it.
void KeepRival(const LocatedEdge& wider, LocatedEdge* narrower);

// Makes a line so far out of the blade the edge's rival.
void SetRival(LocatedEdge* edge, double rival_px);

// By how much the edges would pass the pivot more unequally, signed as their asymmetry, px, if this
// one's rival were its border.
[[nodiscard]] double ByRivalPx(const LocatedBlade& blade);

// Blades mirror each other. Where the edges do not, the view may be oblique or either edge may lie
// elsewhere: both become less certain by a tenth of how unlike they pass the pivot. Where they
// would pass it alike, and half as unlike at most, if the other transition beside one of them were
// its border, that may well be so (a bright bevel on a bright ground): such an edge becomes
// ambiguous, and less certain by 0.6 of the way there. Neither where they differ by less than 1.8 %
// of the length and markers tell the tilt of the view, if the pivot may account for it.
void DoubtUnlikeEdges(const Pivot& pivot, const ScaleResult& scale, Blades* blades);

// A cutting edge is ground as one smooth curve. By how much a twentieth and more of what was
// located is off the curve that the rest follows, and how long the edge is. px
struct Kink {
  double off_px = 0, length_px = 0;
};
[[nodiscard]] Kink KinkOf(const LocatedBlade& blade);

// Whether that is 0.3 % of the length, half a pixel and more than is known of the edge: another
// line was followed part of the way.
[[nodiscard]] bool IsKinked(const Kink& kink, const LocatedEdge& edge);

// A kinked edge becomes ambiguous, and less certain by twice as much as it is off. Throws
// Refused{kLowContrast} where the upper edge is off by 2 %.
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
// are less certain by a hundredth of the blades' length, by three where both are bent to one side.
void DoubtLaterLook(const Scene& scene, const Pivot& pivot, Blades* blades);

// The distal ends of edges that pass although they are no mirror images: one of the edges is
// something else's border, or the view is oblique. Either may turn the angle by as much as they
// differ.
void DoubtUnlikeEnds(const Pivot& pivot, const ScaleResult& scale, Blades* blades);

}  // namespace bladecurve
