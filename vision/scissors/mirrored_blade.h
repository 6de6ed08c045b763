// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/pivot/pivot.h"
#include "vision/scissors/located_blade.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {

// A blade located anew.
struct RelocatedBlade {
  LocatedBlade blade;
  double asymmetry = 0;  // EdgeAsymmetry with the other one
};

// The look for one blade where the other's mirror image lies.
struct MirroredBladeSearch {
  const BladeView& view;
  const Pivot& pivot;
  const LocatedBlade& other;  // whose mirror image it is
  MirrorLine line;
};

// How far off the mirror image the blade was found, px.
[[nodiscard]] double WayPx(const MirroredBladeSearch& search);

// Of the difference between the two edges before, what is left.
[[nodiscard]] double LeftOfDifference(const MirroredBladeSearch& search,
                                      const RelocatedBlade& found);

// The blade with that edge, trimmed. Throws Refused where too little of it is free.
[[nodiscard]] RelocatedBlade BladeWithEdge(const MirroredBladeSearch& search, LocatedEdge edge);

// The blade as it is seen within `search_px` of the mirror image, if it faces the gap there and is
// no shadow on coloured ground.
[[nodiscard]] std::optional<RelocatedBlade> LookNearMirrored(const MirroredBladeSearch& search,
                                                             double search_px);

// The same at the place where a shadow begins; further aside where the way is long.
[[nodiscard]] std::optional<RelocatedBlade> LookInShadow(const MirroredBladeSearch& search,
                                                         double search_px,
                                                         Shadow shadow);

// The same in colours, wherever grey shows it.
[[nodiscard]] std::optional<RelocatedBlade> LookInColours(const MirroredBladeSearch& search,
                                                          double search_px);

// The blade where the other one puts it, if it is seen there and the two are alike then.
[[nodiscard]] std::optional<RelocatedBlade> LookWhereMirrored(const MirroredBladeSearch& search);

// Replaces a blade by the one found; `where` goes into LocatedBlade::moved.
void Replace(const RelocatedBlade& found, const char* where, LocatedBlade* blade);

// Of an edge that is as symmetry has it: it is doubted.
inline constexpr double kAssumedAmbiguity = 0.6;

// Doubts an edge that was found by symmetry, unless that is known to hold.
void MarkAsAssumed(const BladeView& view, const Pivot& pivot, LocatedBlade* blade);

// Replaces a blade likewise where a slant of the view may part the edges as well: then it becomes
// less certain by 0.6 of how far it is moved.
void ReplaceAssumed(const MirroredBladeSearch& search,
                    const RelocatedBlade& found,
                    const char* where,
                    LocatedBlade* blade);

}  // namespace bladecurve
