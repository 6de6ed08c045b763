// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_pair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "vision/edge/edge_curve.h"
#include "vision/image/cross.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scissors/cast_shadow.h"
#include "vision/scissors/dark_band.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/ground_colour.h"
#include "vision/scissors/occluding_border.h"
#include "vision/scissors/scene_guess.h"
#include "vision/scissors/unseen_bevel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Where much of an edge strays, the guess led the look astray: once more, along the curve that most
// of the edge follows, if that tells more.
LocatedEdge AlongItsCurve(const BladeView& view, LocatedEdge edge, bool left) {
  constexpr double kStray = 0.1;   // of the points
  constexpr double kSearchPx = 3;  // the curve's own error, where it had to be continued
  if (InlyingShare(edge) > 1 - kStray) return edge;
  const EdgeGuess guess{PlainCurve(edge.points), left, kSearchPx};
  auto again = UnlessRefused([&] { return view.InGreyOrAnyColours(guess); });
  if (!again || Information(*again) <= Information(edge)) return edge;
  KeepRival(edge, &*again);
  return *std::move(again);
}

LocatedEdge Locate(const BladeView& view, bool left) {
  LocatedEdge edge = view.InGreyOrAnyColours(CuttingEdgeOf(view.scene(), left));
  edge = LeaveSoftShadow(view, std::move(edge), left);
  edge = AlongItsCurve(view, std::move(edge), left);
  return SettleDarkBand(view, std::move(edge), left);
}

Vector2d DirectionOfDistalHalf(const LocatedEdge& edge) {
  return (edge.points.back().trend_px - edge.points[edge.points.size() / 2].trend_px).normalized();
}

// How many points of an edge, from the crotch on, lie before the end of a stretch over which the
// other edge lies on it for longer than where edges cross: one of them was followed on along the
// other blade's. 0 where there is none.
std::size_t CountAlongOther(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kTogetherPx = 2.5;
  constexpr double kLonger = 3, kLeastPx = 20;
  constexpr std::size_t kEnough = 100;  // places along the edge
  const double sine = std::abs(Cross(DirectionOfDistalHalf(edge), DirectionOfDistalHalf(other)));
  const double crossing_px = kLeastPx + kLonger * kTogetherPx / std::max(sine, 1e-6);
  const double spacing_px = (edge.points.back().trend_px - edge.points.front().trend_px).norm() /
                            static_cast<double>(edge.points.size());
  const std::size_t stride = 1 + edge.points.size() / kEnough;
  std::size_t count = 0, together = 0;
  for (std::size_t i = 0; i < edge.points.size(); i += stride) {
    const bool near = DistanceTo(other, edge.points[i].trend_px) < kTogetherPx;
    together = near ? together + stride : 0;
    if (spacing_px * static_cast<double>(together) > crossing_px)
      count = std::min(i + stride, edge.points.size());
  }
  return count;
}

// std::nullopt where the other edge does not lie on this one, or too little is left of it.
std::optional<LocatedEdge> BeyondOther(const BladeView& view,
                                       const LocatedEdge& edge,
                                       const LocatedEdge& other,
                                       bool left) {
  constexpr double kSearchPx = 3;
  const auto count = static_cast<std::ptrdiff_t>(CountAlongOther(edge, other));
  if (count == 0) return std::nullopt;
  const std::vector<Vector2d> path = TrendOf(edge);
  const EdgeGuess guess{{path.begin() + count, path.end()}, left, kSearchPx};
  if (guess.path_px.size() < 2) return std::nullopt;
  auto beyond = UnlessRefused([&] { return view.InGreyOrAnyColours(guess); });
  if (beyond) KeepRival(edge, &*beyond);
  return beyond;
}

// Where the edges lie on each other before they part, as along the top blade's edge over the other
// blade, both are looked for from there on alone.
void LeaveOtherBlade(const BladeView& view, BladeEdges* edges) {
  const auto beyond = ParallelMap(2, [&](int blade) {
    return blade == 0 ? BeyondOther(view, edges->upper, edges->lower, true)
                      : BeyondOther(view, edges->lower, edges->upper, false);
  });
  if (beyond[0]) edges->upper = *beyond[0];
  if (beyond[1]) edges->lower = *beyond[1];
}

// Cut off at white, the step of a glaring blade looks sharper than the other blade's, and lies too
// far out.
bool Glares(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kOverexposed = 0.2, kPlain = 0.05;  // share of an edge
  constexpr double kSharper = 0.85;  // ratio of the blurs; focus and motion differ by less
  constexpr double kOneStep = 0.5;  // ambiguity; the blur of bevel and shadow together is no lens's
  return edge.overexposed > kOverexposed && other.overexposed < kPlain &&
         other.ambiguity < kOneStep && edge.blur_px < kSharper * other.blur_px;
}

// Softer than print and the other blade: a shadow along the edge that was taken for blur.
bool IsTooSoft(const LocatedEdge& edge, const LocatedEdge& other, double most_blur_px) {
  constexpr double kSofter = 1.5;  // ratio; print and blades lie at about one distance
  return std::isfinite(most_blur_px) &&
         edge.blur_px > kSofter * std::max(most_blur_px, BlurOr(other, most_blur_px));
}

// What the other blade tells of an edge's blur: a glaring blade's once more, as sharp as the other;
// a shadow's, with the bound that print gives.
LocatedEdge WithBlurOf(const BladeView& view,
                       const LocatedEdge& other,
                       LocatedEdge edge,
                       bool left) {
  EdgeOptions options = view.options();
  if (Glares(edge, other)) {
    options.blur_px = other.blur_px;
  } else if (IsTooSoft(edge, other, options.most_blur_px)) {
    options.may_be_softer = false;
  } else {
    return edge;
  }
  try {
    return LocateEdge(view.grey(), view.tone(), CuttingEdgeOf(view.scene(), left), options);
  } catch (const Refused&) {
    return edge;  // too little is left without the white pixels; its sigma tells of the glare
  }
}

}  // namespace

BladeEdges LocateBlades(const BladeView& view, Plan plan) {
  BladeEdges edges;
  ParallelFor(2, [&](int blade) {
    if (blade == 0) {
      edges.upper = Locate(view, true);
    } else {
      auto lower = UnlessRefused([&] { return Locate(view, false); });
      edges.lower = lower ? *std::move(lower) : AsTraced(view.scene(), false);
    }
  });
  LeaveOtherBlade(view, &edges);
  LeaveShadows(view, &edges.upper, &edges.lower);
  edges.upper = WithBlurOf(view, edges.lower, std::move(edges.upper), true);
  edges.lower = WithBlurOf(view, edges.upper, std::move(edges.lower), false);
  SettleByColour(view, plan, &edges);
  LeaveCastShadow(view, &edges);
  LeaveNarrowShadow(view, &edges);
  DoubtDarkLine(view, true, &edges.upper);
  DoubtDarkLine(view, false, &edges.lower);
  LeaveBevelsLine(view, &edges);
  ConfirmWhereNothingCasts(view, edges.lower, &edges.upper, true);
  ConfirmWhereNothingCasts(view, edges.upper, &edges.lower, false);
  ConfirmByOcclusion(view, edges.lower, &edges.upper);
  ConfirmByOcclusion(view, edges.upper, &edges.lower);
  return edges;
}

}  // namespace bladecurve
