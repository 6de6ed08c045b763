// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/scale/camera.h"
#include "vision/scale/marker_model.h"
#include "vision/scale/scale.h"
#include "vision/scale/straight_band.h"

namespace bladecurve {

// A pixel that shows a marker.
struct MarkerPixel {
  Eigen::Vector2d place;  // MarkerFrame::Place of what is Straightened
  double light;           // linear, 0 to 1
  int cell;               // MarkerModel::CellOf
};

// Where a camera without distortion would show what is seen at `image_px`.
[[nodiscard]] Eigen::Vector2d Straightened(const std::optional<Camera>& camera,
                                           const Eigen::Vector2d& image_px);

// Where the picture may show the marker with half a cell of paper about it.
[[nodiscard]] cv::Rect BoxAbout(const SeenMarker& marker, double cell_px, const cv::Size& picture);

// The pixels in `box` within some sigmas of blur of a border, some thousands at most, evenly
// spread.
[[nodiscard]] std::vector<MarkerPixel> PixelsAtBorders(const LinearPicture& picture,
                                                       const cv::Rect& box,
                                                       const MarkerFrame& frame,
                                                       const MarkerModel& model,
                                                       const std::optional<Camera>& camera);

// Some of the light in a box, linear, 0 to 1.
[[nodiscard]] std::vector<double> SampleLight(const LinearPicture& picture, const cv::Rect& box);

}  // namespace bladecurve
