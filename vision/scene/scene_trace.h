// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve {

// How far from the contour the edge may lie, in pixels of the image it is traced on.
struct TraceRange {
  double inwards = 4;   // into the blade: the mask may have swallowed a shadow
  double outwards = 2;  // a threshold may have cut a pale border off
};

// Moves each point of `path` along its normal to the strongest transition nearby that is continuous
// along the path (dynamic programming over offsets). `image` is CV_32FC1 or CV_32FC3; `inside` is
// +1 where the blade lies to the left of the path's direction (y down: left is (dy, -dx)), else -1.
// Points come back evenly spaced, about 1 px apart.
[[nodiscard]] std::vector<Eigen::Vector2d> TraceStrongestEdge(
    const cv::Mat& image,
    const std::vector<Eigen::Vector2d>& path,
    int inside,
    const TraceRange& range);

// Points `step` apart along a polyline, its ends included; and the same smoothed by a moving
// average over `width` of length.
[[nodiscard]] std::vector<Eigen::Vector2d> Resample(const std::vector<Eigen::Vector2d>& path,
                                                    double step);
[[nodiscard]] std::vector<Eigen::Vector2d> Smooth(const std::vector<Eigen::Vector2d>& path,
                                                  int half_window);

}  // namespace bladecurve
