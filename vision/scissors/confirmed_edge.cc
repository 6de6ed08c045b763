// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/confirmed_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vision/scissors/consistency.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve {
namespace {

// The ways in which the other edge may pass.
std::vector<double> WaysOf(const LocatedBlade& blade) {
  if (blade.edge.rival_sigma_px > 0) return {0, ByRivalPx(blade)};
  return {0};
}

}  // namespace

void ConfirmMirroredEdges(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kAlike = 1.5, kUnlike = 4;  // standard uncertainties
  if (!KnowsMirror(view, pivot) || pivot.bent) return;
  if (!blades->upper.moved.empty() || !blades->lower.moved.empty()) return;
  const double length_px = BladeLengthPx(pivot, *blades);
  const double sigma_px =
      std::hypot(std::hypot(PartedByPivotPx(pivot, *blades), kGroundAlike * length_px),
                 SigmaWithoutRival(blades->upper.edge),
                 SigmaWithoutRival(blades->lower.edge));
  const double apart_px = pivot.asymmetry * length_px;
  if (std::abs(apart_px) > kAlike * sigma_px) return;
  const std::array<LocatedBlade*, 2> both{&blades->upper, &blades->lower};
  std::array<bool, 2> confirmed{};
  for (const std::size_t i : {0, 1}) {
    const std::vector<double> ways = WaysOf(*both[1 - i]);
    confirmed[i] =
        both[i]->edge.rival_sigma_px > 0 && std::all_of(ways.begin(), ways.end(), [&](double way) {
          return std::abs(apart_px + ByRivalPx(*both[i]) + way) > kUnlike * sigma_px;
        });
  }
  for (const std::size_t i : {0, 1}) {
    if (!confirmed[i]) continue;
    DropRival(&both[i]->edge);
  }
}

}  // namespace bladecurve
