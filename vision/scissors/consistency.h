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

// Whether the edges differ by more than that, in standard uncertainties.
[[nodiscard]] bool DifferBeyondPivot(const Pivot& pivot, const Blades& blades, double sigmas = 3);

// Throws Refused where edges and pivot cannot be those of flat scissors: kOutOfPlane for angled
// blades, kNotScissors for jaws that meet instead of crossing, kAmbiguousPivot where neither a
// screw nor the blades tell where they turn. RefusedForGood for jaws that meet at a screw, all of
// them seen beyond doubt.
void RefuseInconsistent(const Pivot& pivot, const Blades& blades);

// Throws Refused{kClosed} where the distal ends lie on each other, or have passed each other: the
// blades are closed, or both edges are of one blade and its shadow.
void RefuseClosed(const Pivot& pivot, const Blades& blades);

// Whether the edges pass by it as far as those of usual scissors do; jaws' meet there.
[[nodiscard]] bool PassByPivot(const Pivot& pivot);

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
// second look needs more than a faint head. Blades bent to one side, which nothing mirrors, always
// need a head that is seen well. Where none is seen the scene must be plainer: else
// Refused{kAmbiguousPivot}.
void RefuseUnconfirmedScene(const Scene& scene, const ScaleResult& scale, const Pivot& pivot);

}  // namespace bladecurve
