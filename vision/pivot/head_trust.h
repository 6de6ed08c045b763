// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/screw.h"

namespace bladecurve {

struct HeadSearch;  // vision/pivot/head_search.h: what is known beforehand

// ln of the odds that this is the head, fitted all round: views seldom flatten one by more.
[[nodiscard]] double Credence(const Screw& screw);

// Whether a head of which little shows lies near enough to where the blades put the pivot. In a
// known view the edges say more, by mirroring each other about it or not.
[[nodiscard]] bool IsCredibleThere(const Screw& screw, const HeadSearch& known);

// Whether a head of which little shows lies far from where the blades put the pivot, in a view that
// is not known, and from where the silhouette does as well.
[[nodiscard]] bool LiesAstray(const Screw& screw, const HeadSearch& known);

// Whether a head that can be mistaken is flatter than any is in a known view, from which it is seen
// from above.
[[nodiscard]] bool IsTooFlat(const Screw& screw, const HeadSearch& known);

// Whether the edges mirror each other about a place as near to the head as that is known. One that
// lies aside adds to one edge's distance and takes from the other's; of one that hardly shows that
// excuses edges that are suspect, none that are unlike.
[[nodiscard]] bool MirrorNear(const Screw& screw, const HeadSearch& known);

// Whether they mirror each other as far as the view is known. A slanted one parts edges as well,
// but hardly so much about what is too flat for a head.
[[nodiscard]] bool MayMirrorAbout(const Screw& screw, const HeadSearch& known);

// Whether the edges pass by it as nearly alike as by a head in a view that is not known, of a scene
// that is in no doubt; a step at a blade's heel lies on one of the blades.
[[nodiscard]] bool MayPassAlike(const Screw& screw, const HeadSearch& known);

// Whether it lies where the blades alone put the pivot, by so many standard uncertainties.
[[nodiscard]] bool LiesWhereBladesTurn(const Screw& screw,
                                       const HeadSearch& known,
                                       double sigmas = 1);

// Whether a head near the joint is to be trusted: necks of members and engraved marks are round,
// too, but less so than heads, and about few of them the edges mirror each other, the fewest where
// the view is known.
[[nodiscard]] bool IsSureAtJoint(const Screw& screw, const HeadSearch& known);

// The same of one that is wider or smaller than usual: where the blades put the pivot, or with a
// slot from end to end not far from there.
[[nodiscard]] bool IsSureOfUnusualSize(const Screw& screw, const HeadSearch& known);

// The same of one that was seen magnified, as more is that is none: where the blades put the pivot,
// or if the edges mirror each other about it; where a slanted view may part them, also one of which
// all sides show and that lies not far from there, or one with a slot from end to end.
[[nodiscard]] bool IsSureMagnified(const Screw& screw, const HeadSearch& known);

// The same of a half-lit one: if the edges mirror each other about it; where a slanted view may
// part them, also one with a slot from end to end not far from where the blades put the pivot.
[[nodiscard]] bool IsSureHalfLit(const Screw& screw, const HeadSearch& known);

}  // namespace bladecurve
