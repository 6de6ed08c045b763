// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/image/picture_part.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// What a dark band along a blade's edge is.
enum class DarkBand {
  kShadow,  // the background, only darker
  kMetal,   // the blade's bevel
  kUnknown
};

// Judges the band between a located edge and its rival: by colour; where blade and background are
// alike in that, by whether the background's pattern goes on in it. bgr: CV_8UC3, of the photograph
// at full resolution; blade_px: how wide the blade is; other_px: where the other blade's edge runs,
// beyond which there is no background.
[[nodiscard]] DarkBand JudgeDarkBand(const PicturePart& bgr,
                                     const ToneCurve& tone,
                                     const LocatedEdge& edge,
                                     double blade_px,
                                     const std::vector<Eigen::Vector2d>& other_px);

// By the pattern alone: a shadow leaves it as it is, only darker; metal has none of it. So tells a
// background whose pattern goes on for as far as from the band to it. picture: CV_8UC3 or CV_8UC1.
[[nodiscard]] DarkBand JudgeByPattern(const PicturePart& picture,
                                      const ToneCurve& tone,
                                      const LocatedEdge& edge,
                                      const std::vector<Eigen::Vector2d>& other_px);

// Whether the dark band that far within an edge whose rival is a bevel's inner line is the ground
// in shadow: of its colour, and not of the bevel's. bgr: as above.
[[nodiscard]] bool IsGroundBesideBevel(const PicturePart& bgr,
                                       const ToneCurve& tone,
                                       const LocatedEdge& edge,
                                       double width_px);

}  // namespace bladecurve
