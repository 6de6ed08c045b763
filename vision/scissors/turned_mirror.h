// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// Where a blade of which no edge was located may have it: the line near `line` about which the
// other blade's edge falls on a line that is seen along all of it, in light or in colour. The
// outermost one: further in lie those of bevels. std::nullopt where none is seen, or where light
// rises there, going outwards, as it does at the border of a shadow, and another is seen further
// in.
[[nodiscard]] std::optional<MirrorLine> FindTurnedMirror(const BladeView& view,
                                                         const LocatedBlade& other,
                                                         const MirrorLine& line);

}  // namespace bladecurve
