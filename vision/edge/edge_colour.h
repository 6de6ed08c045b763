// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/edge/edge.h"
#include "vision/image/picture_part.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// How far blade and background lie apart beside a guessed edge, in standard deviations of either
// (Fisher 1936). Below about 1 the edge is hidden in shading and texture. grey: CV_8UC1.
[[nodiscard]] double GreySeparation(const cv::Mat& grey,
                                    const ToneCurve& tone,
                                    const EdgeGuess& guess);

// A piece of a colour photograph in the mixture of its channels in which blade and background lie
// furthest apart: Fisher's linear discriminant of the linear light on either side of the guess.
struct ColourView {
  cv::Mat grey;                     // CV_8UC1, linear in light
  ToneCurve tone;                   // of `grey`
  Eigen::Vector2d corner_px{0, 0};  // of `grey` in the photograph
  double separation = 0;            // as GreySeparation's
};

// bgr: CV_8UC3, of the photograph at full resolution. shade: by what share the background's
// light may vary from shadows that lie beside the edge; the mixture shows them the less.
[[nodiscard]] ColourView ViewWhereSidesDiffer(const PicturePart& bgr,
                                              const ToneCurve& tone,
                                              const EdgeGuess& guess,
                                              double shade = 0);

// LocateEdge in that view; points in the photograph's pixels. Throws as LocateEdge does.
[[nodiscard]] LocatedEdge LocateEdgeInView(const ColourView& view, const EdgeGuess& guess);

// The same at half the resolution, at which cameras store colours: there an edge is sharp that is
// soft at the full one, among the sharp borders of what compression leaves.
[[nodiscard]] LocatedEdge LocateEdgeInHalvedView(const ColourView& view, const EdgeGuess& guess);

}  // namespace bladecurve
