// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/unseen_bevel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vision/edge/edge_margin.h"
#include "vision/refused.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

constexpr double kFurtherPx = 1.1;  // of one trail than of the other

// How far light trails off beyond two edges, px.
struct Trails {
  double upper = 0, lower = 0;

  [[nodiscard]] double Further() const { return std::abs(upper - lower); }
  [[nodiscard]] double Usual() const { return std::min(upper, lower); }
  [[nodiscard]] bool OfUpper() const { return upper > lower; }
};

// std::nullopt where they are alike, or cannot be told.
std::optional<Trails> UnlikeTrails(const BladeView& view,
                                   const LocatedEdge& upper,
                                   const LocatedEdge& lower) {
  const auto of_upper = TrailPx(view.grey(), view.tone(), upper);
  const auto of_lower = TrailPx(view.grey(), view.tone(), lower);
  if (!of_upper || !of_lower) return std::nullopt;
  const Trails trails{*of_upper, *of_lower};
  return trails.Further() < kFurtherPx ? std::nullopt : std::optional(trails);
}

// The border of a bevel about `width_px` beyond its line, where light falls as it does at the line.
std::optional<LocatedEdge> BorderBeyond(
    const BladeView& view, const LocatedEdge& line, double width_px, bool left, double blur_px) {
  constexpr double kNearest = 0.5, kFarthest = 1.5;  // of the width
  EdgeOptions options = view.options();
  options.blur_px = blur_px;
  auto border = UnlessRefused(
      [&] { return LocateEdgeBeyond(line, width_px, left, view.grey(), view.tone(), options); });
  if (!border || TypicalContrast(*border) >= 0) return std::nullopt;
  const double beyond_px = MedianDistance(*border, line);
  if (beyond_px < kNearest * width_px || beyond_px > kFarthest * width_px) return std::nullopt;
  return border;
}

}  // namespace

void LeaveBevelsLine(const BladeView& view, BladeEdges* edges) {
  constexpr double kHalf = 0.5;    // of a trail lies beyond the middle of its step
  constexpr double kSofter = 1.5;  // ratio of the blurs
  const auto trails = UnlikeTrails(view, edges->upper, edges->lower);
  if (!trails) return;
  const bool left = trails->OfUpper();
  LocatedEdge& line = left ? edges->upper : edges->lower;
  const LocatedEdge& other = left ? edges->lower : edges->upper;
  // Not where the other edge may lie on such a line itself, or a shadow's; what is softer trails
  // off by its own blur. Nor where a blur is not known.
  if (other.ambiguity > kAsGood || !(line.blur_px <= kSofter * other.blur_px)) return;
  const double width_px = trails->Further() + kHalf * trails->Usual();
  auto border = BorderBeyond(view, line, width_px, left, other.blur_px);
  if (border) line = *std::move(border);
}

void DoubtUnseenBevel(const BladeView& view, Blades* blades) {
  constexpr double kPerFurther = 1.2;  // standard uncertainty per px
  const auto trails = UnlikeTrails(view, blades->upper.edge, blades->lower.edge);
  if (!trails) return;
  Doubt(&(trails->OfUpper() ? blades->upper : blades->lower).edge, kPerFurther * trails->Further());
}

}  // namespace bladecurve
