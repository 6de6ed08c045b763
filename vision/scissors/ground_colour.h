// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scissors/blade_view.h"
#include "vision/stage_log.h"

namespace bladecurve {

// Both edges are compared with where the ground's colour ends: light changes at shadows' borders
// and bevels' lines too. An edge at which only light changes is left for the one at which the
// colour does, or doubted. In large photographs, whose colours take longer to decode than all else
// takes, only where grey leaves a doubt, or shadows might pass for blades unseen, unless the plan
// is full.
void SettleByColour(const BladeView& view, Plan plan, BladeEdges* edges);

// Whether the ground's colour, where it has one, goes on within an edge at which light rises, as it
// does within a shadow's border. other: the other blade's edge.
[[nodiscard]] bool LiesInGround(const BladeView& view,
                                const LocatedEdge& edge,
                                const LocatedEdge& other,
                                bool left);

// Whether the ground's colour, where it has one, ends at an edge. other: the other blade's edge.
[[nodiscard]] bool GroundEndsAt(const BladeView& view,
                                const LocatedEdge& edge,
                                const LocatedEdge& other,
                                bool left);

}  // namespace bladecurve
