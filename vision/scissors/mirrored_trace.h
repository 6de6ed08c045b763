// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// A blade's border that hardly shows, as beside a bevel that mirrors the ground: the line about
// which the other blade's edge falls on it, if the light's course breaks there along the whole.
struct MirroredTrace {
  MirrorLine line;
  double sigma_px = 0;  // of the border, across it, from the line's direction
};

// Looks for the border outwards of where `inner`, a line on the blade, was found; the mirror's
// direction is taken from the two edges and hence off by as much as they differ. None is seen in
// overexposed light.
[[nodiscard]] std::optional<MirroredTrace> FindMirroredTrace(const BladeView& view,
                                                             const LocatedBlade& inner,
                                                             const LocatedBlade& other,
                                                             const MirrorLine& line,
                                                             double difference_px);

}  // namespace bladecurve
