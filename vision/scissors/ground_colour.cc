// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/ground_colour.h"

#include <cmath>
#include <optional>
#include <utility>

#include "vision/edge/colour_border.h"
#include "vision/parallel.h"
#include "vision/scissors/dark_band.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

constexpr double kFarPx = 1.3;  // what colours tell apart

// The colours beside one blade's edge.
struct ColoursBeside {
  const BladeView& view;
  const LocatedEdge& other;  // the other blade's
  bool left;

  // Where the ground's colour ends beside a line.
  [[nodiscard]] std::optional<ColourBorder> BorderAlong(const LocatedEdge& line,
                                                        double told_apart = kToldApart) const {
    const double width_px = BladeOf(view.scene(), left).width_px;
    return FindColourBorder(view.Reduced(), view.tone(), line, other, width_px, told_apart);
  }

  // The edge as it is seen at that border, away from `line`; where that draws the edge back to
  // itself, in colours that show shadows less.
  [[nodiscard]] std::optional<LocatedEdge> EdgeAt(const ColourBorder& border,
                                                  const LocatedEdge& line,
                                                  double told_apart = kToldApart) const {
    constexpr double kSearchPx = 4;
    constexpr double kWay = 0.5;    // of the way there, at least
    constexpr double kShade = 0.5;  // of the light
    const auto is_border = [&](const std::optional<LocatedEdge>& edge) {
      if (!edge || DistanceOfFarthestThird(*edge, line) < kWay * std::abs(border.offset_px))
        return false;
      const auto border_there = BorderAlong(*edge, told_apart);
      return !border_there || std::abs(border_there->offset_px) < kFarPx;
    };
    const EdgeGuess guess{border.path_px, left, kSearchPx};
    for (const double shade : {0.0, kShade}) {
      std::optional<LocatedEdge> coloured = view.InColoursAlone(guess, shade);
      if (!coloured) continue;
      std::optional<LocatedEdge> in_grey = view.ClearerInGrey(*coloured, left);
      if (is_border(in_grey)) return in_grey;
      if (is_border(coloured)) return coloured;
    }
    return std::nullopt;
  }
};

// Whether colours that hardly differ end where grey does along the blade's outer side: compression
// smears them over several pixels.
bool EndWithGrey(const ColoursBeside& colours, double told_apart) {
  const std::optional<LocatedEdge>& side = colours.view.OuterSide(colours.left);
  const auto border = side ? colours.BorderAlong(*side, told_apart) : std::nullopt;
  return border && std::abs(border->offset_px) < kFarPx;
}

// From what may be a shadow's border, at which light rises, inwards to where colours hardly differ,
// if the edge is seen there: a shadow that passes for blade unseen. Where grey leaves a doubt they
// are not asked, and that no edge is seen raises none.
void LeavePassingShadow(const ColoursBeside& colours, LocatedEdge* edge) {
  constexpr double kHardlyApart = 0.05;
  constexpr double kSurelyFarPx = 2;  // what colours tell apart that hardly differ
  if (TypicalContrast(*edge) <= 0 || edge->ambiguity > kAsGood) return;
  const auto border = colours.BorderAlong(*edge, kHardlyApart);
  if (!border || border->offset_px > -kSurelyFarPx) return;
  if (CastsNoShadow(colours.view, *edge, colours.left, border->offset_px) ||
      CastsToOtherSide(colours.view, *edge, colours.left, border->offset_px) ||
      !EndWithGrey(colours, kHardlyApart))
    return;
  if (auto within = colours.EdgeAt(*border, *edge, kHardlyApart)) *edge = *std::move(within);
}

// From a line at which only light changes to the one at which the ground's colour ends. Not inwards
// where light falls, going outwards: that is no shadow's border, and a bright bevel mirrors the
// ground's colour.
void LeaveLightAlone(const ColoursBeside& colours, LocatedEdge* edge) {
  const auto border = colours.BorderAlong(*edge);
  if (!border) return LeavePassingShadow(colours, edge);
  if (std::abs(border->offset_px) < kFarPx) return;
  const bool is_within = border->offset_px < 0;
  const bool rises = TypicalContrast(*edge) > 0;
  if (is_within && rises && CastsNoShadow(colours.view, *edge, colours.left, border->offset_px))
    return;
  const bool stays =
      is_within &&
      (!rises || CastsToOtherSide(colours.view, *edge, colours.left, border->offset_px));
  if (auto there = stays ? std::nullopt : colours.EdgeAt(*border, *edge)) {
    *edge = *std::move(there);
    return;
  }
  SetRival(edge, border->offset_px);
  DoubtForRival(edge, std::abs(border->offset_px));
}

// How far out of an edge the ground's colour ends, where it has one.
std::optional<double> GroundsEndPx(const ColoursBeside& colours, const LocatedEdge& edge) {
  if (!colours.view.ShowsColourAtTop()) return std::nullopt;
  const auto border = colours.BorderAlong(edge);
  return border ? std::optional(border->offset_px) : std::nullopt;
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
  if (plan == Plan::kAsNeeded && view.IsLarge() && !LeavesDoubt(edges->upper) &&
      !LeavesDoubt(edges->lower) && !ShadowsMightPass(view, *edges))
    return;
  const BladeEdges found = *edges;
  ParallelFor(2, [&](int blade) {
    if (blade == 0) {
      LeaveLightAlone({view, found.lower, true}, &edges->upper);
    } else {
      LeaveLightAlone({view, found.upper, false}, &edges->lower);
    }
  });
}

bool LiesInGround(const BladeView& view,
                  const LocatedEdge& edge,
                  const LocatedEdge& other,
                  bool left) {
  if (TypicalContrast(edge) <= 0) return false;
  const auto end_px = GroundsEndPx({view, other, left}, edge);
  return end_px && *end_px <= -kFarPx;
}

bool GroundEndsAt(const BladeView& view,
                  const LocatedEdge& edge,
                  const LocatedEdge& other,
                  bool left) {
  const auto end_px = GroundsEndPx({view, other, left}, edge);
  return end_px && std::abs(*end_px) < kFarPx;
}

}  // namespace bladecurve
