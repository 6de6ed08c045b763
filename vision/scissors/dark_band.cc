// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/dark_band.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vision/edge/edge_shadow.h"
#include "vision/image/blurred_step.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kFaint = 0.25;  // ambiguity; beside dark metal a shadow's begin is a low step

bool HasDarkBand(const LocatedEdge& edge, double least_ambiguity) {
  // Narrower bands are blur on both sides, or the steps' own margins.
  constexpr double kLeast = 2.5, kMost = 4, kPerBlur = 4.5;  // px, px, standard deviations
  const double narrowest =
      std::clamp(kPerBlur * std::sqrt(TotalBlurVariance(edge.blur_px)), kLeast, kMost);
  return edge.ambiguity > least_ambiguity && std::abs(edge.rival_px) >= narrowest;
}

// The edge once more along one side of the dark band beside it, however faint, if it is seen there.
// reach: of the way to the other side.
std::optional<LocatedEdge> AlongLine(const BladeView& view,
                                     std::vector<Vector2d> line_px,
                                     const LocatedEdge& edge,
                                     bool left,
                                     double reach) {
  constexpr double kLeastPx = 1.6;
  return view.InGrey(
      {std::move(line_px), left, std::max(kLeastPx, reach * std::abs(edge.rival_px))});
}

// The same, but not just a faint line of the ground's.
std::optional<LocatedEdge> AlongSide(const BladeView& view,
                                     std::vector<Vector2d> side_px,
                                     const LocatedEdge& edge,
                                     bool left) {
  constexpr double kReach = 0.65;
  std::optional<LocatedEdge> along = AlongLine(view, std::move(side_px), edge, left, kReach);
  return along && !HardlyShowsBeside(*along, edge) ? std::move(along) : std::nullopt;
}

// The edge along the outer side of the dark band beside it, if it is seen there.
std::optional<LocatedEdge> BeyondBand(const BladeView& view, const LocatedEdge& edge, bool left) {
  return edge.rival_px > 0 ? AlongSide(view, edge.rival_path_px, edge, left) : edge;
}

// Whether the blade is as dark along its other side as in the band beside this edge, as rounded
// ones are. Shadows fall to one side.
bool IsRound(const BladeView& view, const LocatedEdge& edge, bool left) {
  constexpr double kWholeBand = 1.7;  // times a margin's width
  const std::optional<LocatedEdge> border = BeyondBand(view, edge, left);
  std::optional<LocatedEdge> outer = view.OuterSide(left);
  if (outer && HasDarkBand(*outer)) outer = BeyondBand(view, *outer, !left);
  if (!border || !outer) return false;
  const auto band = view.MarginOf(*border, left), other = view.MarginOf(*outer, left);
  if (!band || !other || !AreOneShading(*band, *other)) return false;
  return kWholeBand * band->width_px > std::abs(edge.rival_px);
}

// Out of the blade, half way along.
Vector2d TypicalNormal(const LocatedEdge& edge) {
  return edge.points[edge.points.size() / 2].normal;
}

constexpr double kSameWay = 0.94, kAboutSameWay = 0.88;  // cosines

// Whether a side of the scissors that faces as the edge does, and would have to cast a shadow like
// the band between the edge and the line `line_px` out of it, or within, casts none.
bool CastsNone(const BladeView& view,
               const std::optional<LocatedEdge>& side,
               const LocatedEdge& edge,
               double line_px,
               double facing = kSameWay) {
  if (!side || TypicalNormal(*side).dot(TypicalNormal(edge)) < facing) return false;
  const std::optional<Band> band = BandBeside(view.grey(), view.tone(), edge, line_px);
  return band && !MayLieAlong(view.grey(), view.tone(), *side, *band);
}

// Faint bands are not worth the colours.
DarkBand Judge(const BladeView& view, const LocatedEdge& edge, bool left) {
  const std::vector<Vector2d>& other_px = BladeOf(view.scene(), !left).inner_px;
  const double width_px = BladeOf(view.scene(), left).width_px;
  const bool clear = HasDarkBand(edge), is_inner = edge.rival_px > 0;
  const DarkBand band = clear ? JudgeDarkBand(view.Colours(), view.tone(), edge, width_px, other_px)
                              : JudgeByPattern(view.grey(), view.tone(), edge, other_px);
  const bool matters = clear || is_inner;
  if (band == DarkBand::kMetal || !matters) return band;
  const bool is_metal =
      band == DarkBand::kShadow
          ? CastsNoShadow(view, edge, left, edge.rival_px) ||
                CastsToOtherSide(view, edge, left, edge.rival_px)
          : IsRound(view, edge, left) || CastsNone(view, view.ShankSide(left), edge, edge.rival_px);
  return is_metal ? DarkBand::kMetal : band;
}

}  // namespace

bool HasDarkBand(const LocatedEdge& edge) { return HasDarkBand(edge, kAsGood); }

bool CastsNoShadow(const BladeView& view, const LocatedEdge& edge, bool left, double line_px) {
  return CastsNone(view, view.ShankSide(left), edge, line_px) &&
         CastsNone(view, view.OuterSide(!left), edge, line_px, kAboutSameWay);
}

bool CastsToOtherSide(const BladeView& view, const LocatedEdge& edge, bool left, double line_px) {
  constexpr double kByFar = 2;
  const std::optional<LocatedEdge>& outer = view.OuterSide(left);
  if (!outer) return false;
  const double blade_px = BladeOf(view.scene(), left).width_px;
  const auto shadow_px = ShadowBesidePx(view.grey(), view.tone(), *outer, edge, blade_px);
  return shadow_px && *shadow_px > kByFar * std::abs(line_px);
}

LocatedEdge SettleDarkBand(const BladeView& view, LocatedEdge edge, bool left) {
  constexpr double kDoubt = 0.5;  // of the band; in one rendered scene of five the edge is beyond
  if (!HasDarkBand(edge, kFaint)) return edge;
  const bool is_inner = edge.rival_px > 0;
  const DarkBand band = Judge(view, edge, left);
  if (band == DarkBand::kUnknown) {
    if (HasDarkBand(edge) && is_inner) DoubtForRival(&edge, kDoubt * edge.rival_px);
    return edge;
  }
  const bool want_inner = band == DarkBand::kShadow;
  return AlongSide(view, want_inner == is_inner ? TrendOf(edge) : edge.rival_path_px, edge, left)
      .value_or(edge);
}

void LeaveShadows(const BladeView& view, LocatedEdge* left, LocatedEdge* right) {
  const auto is_shadows = [&](const LocatedEdge& edge, bool on_left) {
    return HasDarkBand(edge) && edge.rival_px < 0 &&
           !CastsToOtherSide(view, edge, on_left, edge.rival_px);
  };
  if (!is_shadows(*left, true) || !is_shadows(*right, false)) return;
  const auto l = AlongSide(view, left->rival_path_px, *left, true);
  const auto r = AlongSide(view, right->rival_path_px, *right, false);
  if (!l || !r) return;
  *left = *l;
  *right = *r;
}

void ConfirmWhereNothingCasts(const BladeView& view,
                              const LocatedEdge& other,
                              LocatedEdge* edge,
                              bool left) {
  constexpr double kSomewhatSameWay = 0.5;  // cosine
  if (!HasDarkBand(*edge) || edge->rival_px > 0 || other.ambiguity > kFaint) return;
  if (CastsNone(view, view.OuterSide(!left), *edge, edge->rival_px, kSomewhatSameWay))
    DropRival(edge);
}

std::optional<LocatedEdge> AlongRival(const BladeView& view, const LocatedEdge& edge, bool left) {
  constexpr double kReach = 0.3;  // what is faint is no more than where it was expected
  return AlongLine(view, edge.rival_path_px, edge, left, kReach);
}

std::optional<LocatedEdge> WithinBand(const BladeView& view, const LocatedEdge& edge, bool left) {
  if (!HasDarkBand(edge, kFaint) || edge.rival_px > 0) return std::nullopt;
  return AlongSide(view, edge.rival_path_px, edge, left);
}

}  // namespace bladecurve
