// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/image/picture_part.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// A photograph's colours, reduced.
struct ReducedColours {
  PicturePart bgr;  // CV_8UC3
  double px = 1;    // of the photograph, to one of its own

  [[nodiscard]] Eigen::Vector2d Reduced(const Eigen::Vector2d& full_px) const {
    const auto half = Eigen::Vector2d::Constant(0.5);
    return (full_px + half) / px - half;
  }
};

// The line beside an edge at which the ground's colour gives way to the blade's. Light alone may
// change at other lines too: at a shadow's border, which has the ground's colour on both sides, and
// at a bevel's, which has the blade's.
struct ColourBorder {
  std::vector<Eigen::Vector2d> path_px;  // in the photograph; to a pixel or two of the reduced one
  // How far off the edge it lies for certain, along the third of it where that is most, medians;
  // positive out of the blade. 0 where it may lie at the edge.
  double offset_px = 0;
};

// Chromas that differ by less may be one in another light.
inline constexpr double kToldApart = 0.2;

// Whether some part of a picture is coloured enough to be told from grey steel.
[[nodiscard]] bool ShowsColour(const cv::Mat& bgr, const ToneCurve& tone);

// std::nullopt where blade and ground are alike in colour, to `told_apart`, or the blade mirrors
// the ground: colours go over into each other slowly, or the ground's goes on within the edge
// without a shadow. other: the other blade's edge; blade_px: how wide the blade is.
[[nodiscard]] std::optional<ColourBorder> FindColourBorder(const ReducedColours& colours,
                                                           const ToneCurve& tone,
                                                           const LocatedEdge& edge,
                                                           const LocatedEdge& other,
                                                           double blade_px,
                                                           double told_apart = kToldApart);

}  // namespace bladecurve
