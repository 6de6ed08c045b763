// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/ground_colour.h"

#include <cmath>
#include <optional>
#include <utility>

#include "vision/edge/colour_border.h"
#include "vision/parallel.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

constexpr double kFarPx = 1.3;  // what colours tell apart

// From a line at which only light changes to the one at which the ground's colour ends; where that
// line draws the edge back to itself, in colours that show shadows less. From what may be a
// shadow's border, at which light rises, also to where colours hardly differ, if the edge is seen
// there; that it is not raises no doubt then, and where grey leaves one they are not asked.
void LeaveLightAlone(const BladeView& view,
                     const ReducedColours& colours,
                     const LocatedEdge& other,
                     bool left,
                     LocatedEdge* edge) {
  constexpr double kSearchPx = 4;
  constexpr double kWay = 0.5;    // of the way there, at least
  constexpr double kShade = 0.5;  // of the light
  constexpr double kHardlyApart = 0.05;
  const double width_px = BladeOf(view.scene(), left).width_px;
  double told_apart = kToldApart;
  const auto border_along = [&](const LocatedEdge& line) {
    return FindColourBorder(colours, view.tone(), line, other, width_px, told_apart);
  };
  const auto is_far = [](const auto& border) {
    return border && std::abs(border->offset_px) >= kFarPx;
  };
  auto border = border_along(*edge);
  if (!border && TypicalContrast(*edge) > 0 && edge->ambiguity <= kAsGood) {
    told_apart = kHardlyApart;
    border = border_along(*edge);
    if (border && border->offset_px > 0) return;  // a bevel's line, if anything
  }
  if (!is_far(border)) return;
  const EdgeGuess guess{border->path_px, left, kSearchPx};
  const auto is_border = [&](const std::optional<LocatedEdge>& again) {
    return again && DistanceOfFarthestThird(*again, *edge) >= kWay * std::abs(border->offset_px) &&
           !is_far(border_along(*again));
  };
  for (const double shade : {0.0, kShade}) {
    std::optional<LocatedEdge> coloured = view.InColoursAlone(guess, shade);
    if (!coloured) continue;
    std::optional<LocatedEdge> in_grey = view.ClearerInGrey(*coloured, left);
    for (std::optional<LocatedEdge>* again : {&in_grey, &coloured}) {
      if (!is_border(*again)) continue;
      *edge = **std::move(again);
      return;
    }
  }
  if (told_apart == kHardlyApart) return;
  SetRival(edge, border->offset_px);
  DoubtForRival(edge, std::abs(border->offset_px));
}

bool LeavesDoubt(const LocatedEdge& edge) {
  constexpr double kVaguePx = 0.5;
  return TotalSigma(edge) > kVaguePx || edge.ambiguity > kAsGood;
}

// Whether what is taken for blade is darker than the ground, as shadows are, and the ground may
// have a colour that would tell them apart.
bool ShadowsMightPass(const BladeView& view, const BladeEdges& edges) {
  const bool darker = TypicalContrast(edges.upper) > 0 || TypicalContrast(edges.lower) > 0;
  return darker && view.ShowsColourAtTop();
}

}  // namespace

void SettleByColour(const BladeView& view, Plan plan, BladeEdges* edges) {
  constexpr double kLarge = 6e6;  // px
  const bool costly = static_cast<double>(view.grey().total()) > kLarge;
  if (plan == Plan::kAsNeeded && costly && !LeavesDoubt(edges->upper) &&
      !LeavesDoubt(edges->lower) && !ShadowsMightPass(view, *edges))
    return;
  const ReducedColours colours = view.Reduced();
  const BladeEdges found = *edges;
  ParallelFor(2, [&](int blade) {
    if (blade == 0) {
      LeaveLightAlone(view, colours, found.lower, true, &edges->upper);
    } else {
      LeaveLightAlone(view, colours, found.upper, false, &edges->lower);
    }
  });
}

bool LiesInGround(const BladeView& view,
                  const LocatedEdge& edge,
                  const LocatedEdge& other,
                  bool left) {
  if (TypicalContrast(edge) <= 0 || !view.ShowsColourAtTop()) return false;
  const auto border = FindColourBorder(
      view.Reduced(), view.tone(), edge, other, BladeOf(view.scene(), left).width_px);
  return border && border->offset_px <= -kFarPx;
}

}  // namespace bladecurve
