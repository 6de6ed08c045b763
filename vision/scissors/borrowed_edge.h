// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/pivot.h"
#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Of edges that do not mirror each other about `line`, neither being seen where the other puts it,
// the inner one is replaced by the other's mirror image where that as a whole is seen, too faintly
// to be located by itself: as good as the other edge, the pivot and the trace are, and marked as
// doubtful. In a view of known tilt also where nothing is seen of it, if both blades are clearly
// seen and brighter than the ground: half as far off as the edges differ, standard. In one of
// unknown tilt no clear edge is: that may part them, too. Nor is one within which a bevel is seen.
// Not where the other edge is doubtful itself or hardly shows, or is seen to go on within the band
// between, nor where the pivot may account for the difference, nor about a head that may be none:
// of that the edges say nothing.
void BorrowInnerOne(const BladeView& view,
                    const MirrorLine& line,
                    const Pivot& pivot,
                    Blades* blades);

// In a view of known tilt the outer one of edges far unlike, darker than the ground, is a shadow's
// border if the inner blade hides nothing of it further out than it was found, where that one's
// mirror image lies: it is replaced by the inner one's, a quarter as far off as they differ,
// standard. Not where they are unlike in shape, as blades that are bent to one side.
void BorrowOuterOne(const BladeView& view, const Pivot& pivot, Blades* blades);

// The inner one is the line of a bevel, however clear, if the blade hides the other one's edge up
// to where that has its mirror image: its border is taken as it is seen there, or else the other's
// mirror image if that is seen as above, and marked as doubtful. Where nothing tells whether it
// hides that, but the mirror image is seen, at a shadow's end perhaps, the inner one is doubted: by
// half as much, standard, as the two lie apart. Neither where that is further than bevels are wide.
void SettleInnerOne(const BladeView& view, const Pivot& pivot, Blades* blades);

// Of edges that are unlike in shape, one that is doubtful or kinked is replaced by the mirror image
// of the other, if that is clear and runs smoothly, displaced to where most of the doubtful one
// lies on it, if some of the rest lies within the blade then: it has strayed. Whether it was.
bool BorrowDoubtfulOne(const BladeView& view, const Pivot& pivot, Blades* blades);

}  // namespace bladecurve
