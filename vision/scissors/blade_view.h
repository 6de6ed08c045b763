// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/edge/colour_border.h"
#include "vision/edge/edge.h"
#include "vision/edge/edge_colour.h"
#include "vision/edge/edge_margin.h"
#include "vision/image/picture_part.h"
#include "vision/photo/photo.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The cutting edges of both blades, stored pixels. The upper blade is the left one, seen from the
// pivot towards the tips.
struct BladeEdges {
  LocatedEdge upper, lower;
};

// A photograph in which the edges of blades are looked for, and what is known of it before: in
// grey, and in colours, which are decoded when they are first asked for, from any thread. Outlives
// none of its arguments.
class BladeView {
 public:
  BladeView(const Photo& photo, const ScaleResult& scale, const Scene& scene);

  [[nodiscard]] const Photo& photo() const { return photo_; }
  [[nodiscard]] const ScaleResult& scale() const { return scale_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const cv::Mat& grey() const { return photo_.grey(); }
  [[nodiscard]] const ToneCurve& tone() const { return scale_.tone; }
  [[nodiscard]] const EdgeOptions& options() const { return options_; }

  // The edge along `guess` in grey, where that has two points and it is seen; with a bound on its
  // blur, if print shows one.
  [[nodiscard]] std::optional<LocatedEdge> InGrey(const EdgeGuess& guess) const;

  // Where grey hides the edge, or shows it so faintly that colours place it twice as well, in the
  // mixture of the colours in which blade and background differ most. Not before: the mixture
  // depends on what lies somewhere beside the edge, grey on the step at the edge alone. Throws
  // Refused as LocateEdge does.
  [[nodiscard]] LocatedEdge InGreyOrColours(const EdgeGuess& guess) const;

  // The same, colours also at half the resolution.
  [[nodiscard]] LocatedEdge InGreyOrAnyColours(const EdgeGuess& guess) const;

  // In colours, at half the resolution if need be. shade: as for ViewWhereSidesDiffer.
  [[nodiscard]] std::optional<LocatedEdge> InColoursAlone(const EdgeGuess& guess,
                                                          double shade) const;

  // In grey, which is sharper, where that shows an edge where colours do.
  [[nodiscard]] std::optional<LocatedEdge> ClearerInGrey(const LocatedEdge& coloured,
                                                         bool blade_on_left) const;

  // The mixture of the colours in which the sides of an edge differ most, if it parts them much
  // better than grey does.
  [[nodiscard]] std::optional<ColourView> InBetterColours(const EdgeGuess& guess) const;

  // As the place where a shadow begins.
  [[nodiscard]] std::optional<LocatedEdge> InShadow(const EdgeGuess& guess,
                                                    Shadow shadow = Shadow::kDarker) const;

  // The outer side of a blade, and the side of its shank that faces as its cutting edge does.
  // Looked for when they are first asked for, from any thread.
  [[nodiscard]] const std::optional<LocatedEdge>& OuterSide(bool left) const;
  [[nodiscard]] const std::optional<LocatedEdge>& ShankSide(bool left) const;

  // Along an edge or outer side of a blade; std::nullopt where there is none.
  [[nodiscard]] std::optional<Margin> MarginOf(const LocatedEdge& edge, bool left) const;
  [[nodiscard]] std::optional<Margin> DarkLineOf(const LocatedEdge& edge, bool left) const;

  // BGR, about the blades; and at half the resolution, at which colours are stored anyway, where
  // the photograph is large.
  [[nodiscard]] const PicturePart& Colours() const;
  // Whether they have been decoded, and whether that takes long.
  [[nodiscard]] bool HasColours() const { return !colours_.pixels.empty(); }
  [[nodiscard]] bool IsLarge() const;
  [[nodiscard]] const ReducedColours& Reduced() const;
  // Whether the topmost rows, which stand for the ground, show a colour.
  [[nodiscard]] bool ShowsColourAtTop() const;

 private:
  template <typename Look>
  [[nodiscard]] LocatedEdge InGreyOr(const Look& look, const EdgeGuess& guess) const;
  template <typename Look>
  [[nodiscard]] std::optional<LocatedEdge> InColours(const Look& look,
                                                     const EdgeGuess& guess) const;

  struct Side {
    std::once_flag looked_for;
    std::optional<LocatedEdge> edge;
  };

  const Photo& photo_;
  const ScaleResult& scale_;
  const Scene& scene_;
  EdgeOptions options_;
  mutable std::once_flag decoded_, halved_, top_seen_;
  mutable bool coloured_at_top_ = false;
  mutable PicturePart colours_;
  mutable ReducedColours reduced_;
  mutable std::array<Side, 2> outer_sides_, shank_sides_;  // the left blade's first
};

// What an edge's points tell about where it runs, for comparison with another along it. 1/px^2.
[[nodiscard]] double Information(const LocatedEdge& edge);

// Share of the points that count.
[[nodiscard]] double InlyingShare(const LocatedEdge& edge);

// How many points lie beyond the last one that counts, towards the tip.
[[nodiscard]] std::size_t LostPoints(const LocatedEdge& edge);

[[nodiscard]] std::vector<Eigen::Vector2d> TrendOf(const LocatedEdge& edge);

// Between one edge and another along it, px: the median; and that over the third of the edge where
// they are farthest apart.
[[nodiscard]] double MedianDistance(const LocatedEdge& edge, const LocatedEdge& other);
[[nodiscard]] double DistanceOfFarthestThird(const LocatedEdge& edge, const LocatedEdge& other);

// Ambiguity below which no other transition matches an edge's.
inline constexpr double kAsGood = 0.45;

}  // namespace bladecurve
