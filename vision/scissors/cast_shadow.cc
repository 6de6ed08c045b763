// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/cast_shadow.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vision/edge/edge_shadow.h"
#include "vision/edge/edge_tread.h"
#include "vision/scissors/dark_band.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/occluding_border.h"

namespace bladecurve {
namespace {

bool IsSoftShadowsBorder(const LocatedEdge& edge, double most_blur_px) {
  constexpr double kVague = 0.6;  // px
  return std::isfinite(most_blur_px) && edge.slope_sigma_px > kVague && !HasDarkBand(edge) &&
         TypicalContrast(edge) > 0;
}

// Between two lines that far within an edge.
EdgeGuess Within(const LocatedEdge& edge, double nearest_px, double farthest_px, bool left) {
  EdgeGuess guess{{}, left, 0.5 * (farthest_px - nearest_px)};
  for (const LocatedEdgePoint& p : edge.points)
    guess.path_px.push_back(p.trend_px - 0.5 * (nearest_px + farthest_px) * p.normal);
  return guess;
}

// The edge as much further in as the shadow is wide, if light clearly changes there, as it does not
// where the margin is but shading; doubted unless it is sure to be a shadow, whose border is its
// rival.
LocatedEdge WhereShadowBegins(
    const BladeView& view, LocatedEdge edge, const Margin& shadow, bool is_sure, bool left) {
  constexpr double kReach = 0.2, kLeast = 3;  // of the width, px; bevels end further in
  constexpr double kUnclear = 0.75;           // ambiguity
  constexpr double kDoubt = 0.5;              // of the width
  const double reach_px = std::max(kLeast, kReach * shadow.width_px);
  std::optional<LocatedEdge> begins =
      view.InShadow(Within(edge, shadow.width_px - reach_px, shadow.width_px + reach_px, left),
                    shadow.than_blade);
  if (!begins || begins->ambiguity > kUnclear) return edge;
  if (is_sure) return *std::move(begins);
  SetRival(&*begins, shadow.width_px);
  DoubtForRival(&*begins, kDoubt * shadow.width_px);
  return *std::move(begins);
}

std::optional<Margin> MarginAlong(const BladeView& view,
                                  const std::optional<LocatedEdge>& side,
                                  bool left) {
  return side ? view.MarginOf(*side, left) : std::nullopt;
}

// Whether a margin lies along the blade's own shank as well, which is no lower and casts one at
// least as wide. A dark one along the other shank as well may mean that light falls off towards the
// sides of rounded ones, and a bevel may be as dark as that; but it falls off slowly there.
bool IsShadowOfShank(const BladeView& view, const Margin& margin, bool left) {
  constexpr double kLeastPx = 6;    // narrower margins may be blur on any shank
  constexpr double kAsWide = 0.95;  // of the margin
  if (margin.width_px <= kLeastPx) return false;
  const std::optional<LocatedEdge>& shank = view.ShankSide(left);
  const auto of_shank = MarginAlong(view, shank, left);
  if (!of_shank || of_shank->width_px < kAsWide * margin.width_px ||
      !AreOneShadow(margin, *of_shank))
    return false;
  const auto of_other = MarginAlong(view, view.ShankSide(!left), !left);
  return !of_other || of_other->than_blade != Shadow::kDarker ||
         EndsSharply(view.grey(), view.tone(), *shank, *of_shank);
}

// Whether a margin lies along the other blade's outer side as well. Where it lies along the own
// shank too, it may be narrower there: the side may face another way by a little.
bool IsShadowOfOtherBlade(const BladeView& view, const Margin& margin, bool left) {
  constexpr double kSameWidth = 3;
  const auto of_outer = MarginAlong(view, view.OuterSide(!left), !left);
  if (!of_outer || !AreOneShadow(margin, *of_outer, kSameWidth)) return false;
  if (AreOneShadow(margin, *of_outer)) return true;
  const auto of_shank = MarginAlong(view, view.ShankSide(left), left);
  return of_shank && AreOneShadow(margin, *of_shank);
}

// Whether a dark margin that ends sharply lies along the side, if it is seen.
std::optional<Margin> SharpMarginAlong(const BladeView& view,
                                       const std::optional<LocatedEdge>& side,
                                       bool left) {
  const auto margin = MarginAlong(view, side, left);
  const bool sharp = margin && margin->than_blade == Shadow::kDarker &&
                     EndsSharply(view.grey(), view.tone(), *side, *margin);
  return sharp ? margin : std::nullopt;
}

// Whether both the blade's own shank and the other blade's outer side cast a hard shadow as dark as
// the margin, and the blade's outer side, which faces the light, none: then this edge has to cast
// one as well.
bool IsShadowOfWholeSide(const BladeView& view, const Margin& margin, bool left) {
  constexpr double kNoWider = 1.2;
  if (margin.than_blade != Shadow::kDarker) return false;
  const auto of_shank = SharpMarginAlong(view, view.ShankSide(left), left);
  if (!of_shank || !AreAsDark(margin, *of_shank)) return false;
  const auto of_outer = SharpMarginAlong(view, view.OuterSide(!left), !left);
  if (!of_outer || !AreAsDark(margin, *of_outer)) return false;
  return margin.width_px <= kNoWider * std::max(of_shank->width_px, of_outer->width_px) &&
         !SharpMarginAlong(view, view.OuterSide(left), left);
}

// Whether a dark margin has the ground's colour, and the bevel that is seen within it has not.
bool IsShadowBesideBevel(const BladeView& view, const Margin& margin, const LocatedEdge& edge) {
  return margin.than_blade == Shadow::kDarker && HasBevelWithin(edge) && view.ShowsColourAtTop() &&
         IsGroundBesideBevel(view.Colours(), view.tone(), edge, margin.width_px);
}

// The share of the ground's light in what lies along the inner side of an edge of dark metal and is
// brighter than that, narrow or wide.
std::optional<double> ShareOfBrightStrip(const BladeView& view,
                                         const std::optional<LocatedEdge>& side,
                                         bool left) {
  if (!side) return std::nullopt;
  if (const auto tread = FindTread(view.grey(), view.tone(), *side)) return tread->share;
  const auto margin = view.MarginOf(*side, left);
  if (!margin || margin->than_blade != Shadow::kBrighter) return std::nullopt;
  return margin->light / margin->ground;
}

// Whether two strips may be of one shadow by their light.
bool MayBeOneShadow(double share, const std::optional<double>& other_share) {
  constexpr double kSame = 1.5;
  return other_share && share < kSame * *other_share && *other_share < kSame * share;
}

// Every point, out of the blade.
void MoveAcross(LocatedEdge* edge, double px) {
  for (LocatedEdgePoint& p : edge->points) {
    p.point_px += px * p.normal;
    p.trend_px += px * p.normal;
  }
}

void LeaveOwnNarrowShadow(const BladeView& view, LocatedEdge* edge, bool left) {
  constexpr double kDoubt = 0.35;                               // of the width
  if (edge->rival_px > 0 && edge->ambiguity > kAsGood) return;  // a shadow was left before
  const auto tread = FindTread(view.grey(), view.tone(), *edge);
  if (!tread) return;
  const std::optional<LocatedEdge>& outer = view.OuterSide(left);
  if (!outer || ShareOfBrightStrip(view, outer, left)) return;
  if (!MayBeOneShadow(tread->share, ShareOfBrightStrip(view, view.OuterSide(!left), !left)) &&
      !MayBeOneShadow(tread->share, ShareOfBrightStrip(view, view.ShankSide(left), left)))
    return;
  MoveAcross(edge, tread->begins_px);
  SetRival(edge, tread->width_px);
  DoubtForRival(edge, kDoubt * tread->width_px);
}

}  // namespace

LocatedEdge LeaveSoftShadow(const BladeView& view, LocatedEdge edge, bool left) {
  constexpr double kNearest = 1.2, kFarthest = 3.5;  // px; times the edge's uncertainty
  if (!IsSoftShadowsBorder(edge, view.options().most_blur_px)) return edge;
  return view.InShadow(Within(edge, kNearest, kFarthest * edge.common_sigma_px, left))
      .value_or(std::move(edge));
}

void LeaveCastShadow(const BladeView& view, BladeEdges* edges) {
  const auto of_upper = view.MarginOf(edges->upper, true);
  const auto of_lower = view.MarginOf(edges->lower, false);
  const bool alone = of_upper.has_value() != of_lower.has_value();  // else both may be bevels
  const auto leave = [&](const std::optional<Margin>& margin, bool left) {
    if (!margin) return;
    LocatedEdge& edge = left ? edges->upper : edges->lower;
    const LocatedEdge& other = left ? edges->lower : edges->upper;
    const bool is_sure =
        OcclusionBeside(view, edge, -margin->width_px, other) == Occlusion::kNone ||
        IsShadowBesideBevel(view, *margin, edge);
    if (is_sure || IsShadowOfShank(view, *margin, left) ||
        IsShadowOfWholeSide(view, *margin, left) ||
        (alone && IsShadowOfOtherBlade(view, *margin, left)))
      edge = WhereShadowBegins(view, std::move(edge), *margin, is_sure, left);
  };
  leave(of_upper, true);
  leave(of_lower, false);
}

void LeaveNarrowShadow(const BladeView& view, BladeEdges* edges) {
  LeaveOwnNarrowShadow(view, &edges->upper, true);
  LeaveOwnNarrowShadow(view, &edges->lower, false);
}

void DoubtDarkLine(const BladeView& view, bool left, LocatedEdge* edge) {
  constexpr double kDoubt = 0.5;  // of the width
  const auto line = view.DarkLineOf(*edge, left);
  if (!line) return;
  SetRival(edge, -line->width_px);
  DoubtForRival(edge, kDoubt * line->width_px);
}

}  // namespace bladecurve
