// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/scissors/tip_cap.h"

namespace bladecurve {

// Where a cutting edge begins to round off into the tip.
struct DistalEnd {
  Eigen::Vector2d point_px = Eigen::Vector2d::Zero();
  std::size_t index =
      0;  // first point of the edge that belongs to the tip; the size of the edge if none does
  double along_sigma_px = 0;   // standard uncertainty along the edge
  double across_sigma_px = 0;  // across it, beside that of the edge's points
  bool arc_seen = false;       // the tip's arc is seen to leave the edge there
  double evidence = 0;         // of the arc, TipCap::Evidence
  bool certain = false;        // no arc of so many lines, as round or as plain as that, is chance
};

struct DistalEnds {
  DistalEnd likely;
  std::vector<DistalEnd> rivals;  // by other arcs
};

struct EndSearch {
  TipSearch tip;
  double edge_sigma_px = 0;  // scatter of one point across the edge
};

// `edge` runs from the crotch to the tip, points about evenly spaced. By the arc of the tip where
// that is seen, at the presumed tip or beyond it where the step across the edge ends; an arc where
// that ends before the presumed tip is a rival unless it is certain. So are one far beyond which it
// goes on, and sharp ones before one that is soft, as a shadow's is. Where a blade ends before the
// presumed tip (followed_step.h) that is its shadow's, and the end is looked for there; a dark
// blade, if it ends on an arc like its edge. Else by where the edge leaves its smooth course: least
// squares over the place t0 from which on the residual grows as (t - t0)^2 / (2 R); or by what tips
// usually are, whichever is more certain. Fewer than 12 points: the last point, with the length of
// the edge as its uncertainty.
[[nodiscard]] DistalEnds FindDistalEnds(const cv::Mat& grey,
                                        const std::vector<Eigen::Vector2d>& edge,
                                        const EndSearch& search);

}  // namespace bladecurve
