// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/scissors/blade_view.h"

namespace bladecurve {

// Whether beside the edge another transition could be the blade's border instead, with a dark band
// between the two: the ground in shadow, or a bevel.
[[nodiscard]] bool HasDarkBand(const LocatedEdge& edge);

// Whether the band between an edge and the line `line_px` out of it, or within, cannot be a shadow
// that the blade casts: its own shank and the other blade's outer side face the same way, and would
// both have to cast one like it, and neither does.
[[nodiscard]] bool CastsNoShadow(const BladeView& view,
                                 const LocatedEdge& edge,
                                 bool left,
                                 double line_px);

// Whether the blade's outer side casts a shadow, wider than the band between an edge and that line
// by far: light comes from the edge's side.
[[nodiscard]] bool CastsToOtherSide(const BladeView& view,
                                    const LocatedEdge& edge,
                                    bool left,
                                    double line_px);

// Of the two sides of a dark band, the inner one if it is the ground in shadow, the outer one if it
// is metal: by colour, by the ground's pattern, by what the blade's other side and its shank show.
// Within a band that is either, the edge is in doubt. The edge as it is where it has no band.
[[nodiscard]] LocatedEdge SettleDarkBand(const BladeView& view, LocatedEdge edge, bool left);

// Of a pair of blades only the one on top shows its bevel: dark bands along both edges are hard
// shadows, and both borders the bands' inner sides. Not where one of the edges faces the light.
void LeaveShadows(const BladeView& view, LocatedEdge* left, LocatedEdge* right);

// A dark band within an edge is a bevel, and the edge in no doubt for it, where the other blade's
// outer side, which faces somewhat the same way, casts no shadow like it, and no band lies beside
// the other edge, which faces away from that side: light would have to come just along that blade.
void ConfirmWhereNothingCasts(const BladeView& view,
                              const LocatedEdge& other,
                              LocatedEdge* edge,
                              bool left);

// The edge along its rival, however faint, if it is seen there.
[[nodiscard]] std::optional<LocatedEdge> AlongRival(const BladeView& view,
                                                    const LocatedEdge& edge,
                                                    bool left);

// The edge along the inner side of a dark band beside it, however faint, if it is seen there.
[[nodiscard]] std::optional<LocatedEdge> WithinBand(const BladeView& view,
                                                    const LocatedEdge& edge,
                                                    bool left);

}  // namespace bladecurve
