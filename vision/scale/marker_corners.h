// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/scale/camera.h"
#include "vision/scale/marker_detector.h"
#include "vision/scale/scale.h"
#include "vision/scale/straight_edge.h"

namespace bladecurve {

struct MarkerCornerOptions {
  double search_px = 2;          // how far off the rough corners may be
  std::optional<Camera> camera;  // its lens bends the sides; absent: straight
};

// The piece of a marker's side k (from corner k to the next) that neither corner blurs.
[[nodiscard]] StraightEdgeGuess MarkerSide(const std::array<Eigen::Vector2d, 4>& corners_px,
                                           int side,
                                           const MarkerCornerOptions& options);

// Corners by all borders of the marker's cells (FitMarker); where some of those are covered, as
// intersections of lines fitted to the four sides. Where a side cannot be located, or
// the four do not look like a dark square on light paper, the rough corners come back with
// corner_sigma_px NaN.
[[nodiscard]] SeenMarker LocateMarkerCorners(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const RoughMarker& rough,
                                             const MarkerCornerOptions& options);

// How thoroughly to look.
enum class MarkerEffort {
  kQuick,     // one small version of the picture: 4 ms at 12 MP
  kThorough,  // larger versions, if nothing was found on the small one
};
[[nodiscard]] std::vector<SeenMarker> FindMarkers(const cv::Mat& grey,
                                                  const ToneCurve& tone,
                                                  MarkerEffort effort);

// The same markers with corners located anew, for a better tone curve or a lens now known.
[[nodiscard]] std::vector<SeenMarker> RelocateMarkers(const cv::Mat& grey,
                                                      const ToneCurve& tone,
                                                      const std::vector<SeenMarker>& markers,
                                                      const std::optional<Camera>& camera);

}  // namespace bladecurve
