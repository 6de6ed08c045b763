// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/scene/background.h"
#include "vision/scene/scene_candidate.h"
#include "vision/scene/scene_view.h"

namespace bladecurve {

// Sides of the small pictures, px. Blades of a sixth of the picture keep 100 px; more costs time
// and finds no more. Walls are pixels thick: gaps between blades need more of them.
inline constexpr int kSmallSide = 640;
inline constexpr int kOutlineSide = 960;

struct GreyPicture {
  std::shared_ptr<const ScaledImage> at;
  cv::Mat ignore;  // the markers
  BackgroundModel background;
};
[[nodiscard]] GreyPicture GreyOnGround(const SceneView& view);
[[nodiscard]] GreyPicture LightnessOf(const ColourPictures& colour);
// From the background, in units of its scatter; CV_32FC1, 0 where ignored.
[[nodiscard]] cv::Mat DistanceIn(const GreyPicture& grey);

// By lightness alone.
[[nodiscard]] Rung GreyRung(const SceneView& view, const GreyPicture& grey);
// Of things that stand out in grey (CV_8UC1), what casts a shadow of another tone (see
// MasksOfShadowCaster, also for `coloured`); without candidates where nothing does.
[[nodiscard]] Rung CasterRung(const SceneView& view,
                              const GreyPicture& grey,
                              const cv::Mat& things,
                              const cv::Mat& coloured);
// By colour and lightness (Lab).
[[nodiscard]] Rung ColourRung(const SceneView& view, const ColourPictures& colour);
// By what a shadow does not do to the background.
[[nodiscard]] Rung ShadowBlindRung(const SceneView& view, const ColourPictures& colour);
// By a distance of those without lines, as of a cutting mat's grid.
[[nodiscard]] Rung BroadRung(const SceneView& view,
                             const ColourPictures& colour,
                             const cv::Mat& distance);

// By a graph cut, what has the colours of what lies about --pivot, which is given.
[[nodiscard]] Rung CutRung(const SceneView& view, const ColourPictures& colour);

// The sharp outlines of a picture, which two rungs go by.
struct Outlines {
  ColourPictures colour;
  cv::Mat ground;  // as GroundAtFrame gives it
  // Wider gaps closed keep together faint outlines, narrower ones blades with little between them.
  struct ClosedWalls {
    int closed_px = 0;
    cv::Mat walls;
  };
  std::vector<ClosedWalls> closed;
};
[[nodiscard]] Outlines OutlinesIn(const SceneView& view);

// By sharp outlines without a gap, whatever the colours.
[[nodiscard]] Rung FloodRung(const SceneView& view, const Outlines& outlines);
// By outlines that are sharp on the average of their length. Soft shadows have none; but a bevel's
// or a hard shadow's line is one, too.
[[nodiscard]] Rung RegionRung(const SceneView& view, const Outlines& outlines);

}  // namespace bladecurve
