// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace bladecurve {

// The rounded end of a blade: an arc that leaves the cutting edge tangentially.
struct TipCap {
  Eigen::Vector2d end_px{0, 0};  // where the arc leaves the edge: the distal end
  double radius_px = 0;
  double scatter_px = 0;   // of the outline seen about the arc, robust
  int seen = 0;            // lines along which the outline was seen
  double step = 0;         // grey values beyond it less within, typically
  bool in_shadow = false;  // beyond it lies the blade's own shadow
  double sharpness = 1;    // of the ends on the arc, typically: 0.7 in focus; 1 where not measured

  [[nodiscard]] double Evidence() const { return seen * std::abs(step); }
};

struct TipSearch {
  Eigen::Vector2d tip_px{0, 0};  // roughly the furthest point of the blade
  double reach_px = 10;          // how far from there the outline may lie
  double blade_width_px = 0;     // half way along the blade
  bool blade_on_left = true;     // of the edge, as in EdgeGuess
  double blur_px = 0.9;  // of the edge: beyond a narrow shadow beside it the ground is bright
};

// Looks along lines parallel to the cutting edge, within the blade, for where the blade ends, and
// fits the arc to what they show. It needs no visible edge near the tip: bevels often mirror the
// background there. Where what ends first is followed by a dark strip that ends more softly, that
// is the blade's shadow. grey: CV_8UC1. `edge` runs from the crotch to about the tip. std::nullopt
// where too few lines show an end.
[[nodiscard]] std::optional<TipCap> FitTipCap(const cv::Mat& grey,
                                              const std::vector<Eigen::Vector2d>& edge,
                                              const TipSearch& search);

// What tips usually are, where no arc shows: a tenth of the blade's width in radius, from the edge
// continued to `search.tip_px`. Good to about its radius along the edge; `seen` is 0. `edge` holds
// at least 12 points.
[[nodiscard]] TipCap UsualTipCap(const std::vector<Eigen::Vector2d>& edge, const TipSearch& search);

}  // namespace bladecurve
