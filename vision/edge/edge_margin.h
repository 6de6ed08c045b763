// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/edge/edge.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// What lies along the inner side of an edge and is unlike the blade further in, and darker than the
// ground: a bevel, or a shadow that was taken for blade.
struct Margin {
  double width_px = 0;
  double light = 0, ground = 0;  // linear light
  Shadow than_blade = Shadow::kDarker;
};

// std::nullopt where there is none. grey: CV_8UC1; blade_px: how wide the blade is.
[[nodiscard]] std::optional<Margin> FindMargin(const cv::Mat& grey,
                                               const ToneCurve& tone,
                                               const LocatedEdge& edge,
                                               double blade_px);

// Whether a dark margin ends as sharply as ground in shadow does at metal. Light that falls off
// towards the side of a rounded one does so all the way.
[[nodiscard]] bool EndsSharply(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const LocatedEdge& edge,
                               const Margin& margin);

// A dark line along the inner side of an edge, narrower than what FindMargin tells from blur.
// std::nullopt where there is none.
[[nodiscard]] std::optional<Margin> FindDarkLine(const cv::Mat& grey,
                                                 const ToneCurve& tone,
                                                 const LocatedEdge& edge,
                                                 double blade_px);

// How far out of an edge light falls to the darkest beside it but for a tenth of the step, px,
// where the blade is clearly the brighter. It trails off beyond the blur where the edge is the line
// of a bevel that mirrors a dark ground and is hardly brighter than that; shadows are darker.
// std::nullopt elsewhere.
[[nodiscard]] std::optional<double> TrailPx(const cv::Mat& grey,
                                            const ToneCurve& tone,
                                            const LocatedEdge& edge);

// How far from an edge on a shadow lies on the ground: much darker than beside the other edge, from
// where the blur ends, and then about as light again. std::nullopt where there is none, where it is
// wider than that, or out of the picture.
[[nodiscard]] std::optional<double> ShadowBesidePx(const cv::Mat& grey,
                                                   const ToneCurve& tone,
                                                   const LocatedEdge& edge,
                                                   const LocatedEdge& other,
                                                   double widest_px);

// What lies between an edge and a line beside it.
struct Band {
  double width_px = 0;
  double light = 0;  // linear, half way between the two
};

// As far as `line_px` out of the edge, or within. std::nullopt out of the picture.
[[nodiscard]] std::optional<Band> BandBeside(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const LocatedEdge& edge,
                                             double line_px);

// Whether a strip about as light as the band, and a third as wide, its blurred sides left out, lies
// along another edge on either side: if it does not, and that faces the same way, the band is no
// shadow. True where the picture ends.
[[nodiscard]] bool MayLieAlong(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const LocatedEdge& edge,
                               const Band& band);

// Whether margins along the two sides of a blade are how light falls off towards the borders of a
// rounded one: dark, alike in light and width, before the same ground.
[[nodiscard]] bool AreOneShading(const Margin& a, const Margin& b);

// Whether margins take about the same share of light from their grounds.
[[nodiscard]] bool AreAsDark(const Margin& a, const Margin& b);

// Whether margins of two edges that face the same way are one shadow: alike in light, before the
// same ground, and neither wider than the other by the factor `same_width`. Bevels are ground on
// cutting edges, not on the blades' outer sides.
[[nodiscard]] bool AreOneShadow(const Margin& a, const Margin& b, double same_width = 2);

}  // namespace bladecurve
