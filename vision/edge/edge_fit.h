// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge_path.h"
#include "vision/edge/edge_slice.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// How an edge is fitted once its transition is known to a pixel or so.
struct EdgeFitOptions {
  // How far there is no other transition on either side, along the edge from start to end (evenly
  // spaced).
  std::vector<double> inner_px = {kFree}, outer_px = {kFree};
  static constexpr double kFree = 1e3;
  double blur_px = 0.9;         // known to a factor of two; 0.9 is usual
  bool blur_known = false;      // blur_px is right and stays
  double most_blur_px = kFree;  // blur is no more
  bool may_be_softer = true;    // unless the blade's side is as soft
};

struct EdgeFit {
  EdgePath path;                  // within a fraction of a pixel of the edge
  std::vector<EdgeSlice> slices;  // sigma infinite where there are no pixels
  int spacing = 1;                // of the slices, samples: long edges need not all of their pixels
  double seen = 0;                // share of the windows that place the edge to a third of a pixel
  double blur_px = 0;
  double unbound_blur_px = 0;  // as if options.most_blur_px bounded nothing
  bool softer = false;         // it looks more blurred than options.blur_px lets it be
  bool even = false;           // light slopes on neither side of it
  double overexposed =
      0;  // share of the path beside which one side is white beyond the picture's range
};

// Maximum likelihood of the model of edge_levels.h on the raw pixels beside `start`, which lies
// within about 1.5 px of the edge. Blur is shared along the edge; levels and offset are local to
// windows of about 50 px.
[[nodiscard]] EdgeFit FitEdge(const cv::Mat& grey,
                              const ToneCurve& tone,
                              const std::vector<Eigen::Vector2d>& start,
                              bool blade_on_left,
                              const EdgeFitOptions& options);

}  // namespace bladecurve
