// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/photo/photo.h"

namespace bladecurve {

// What is drawn over a photograph. Pixels are displayed pixels.
struct Overlay {
  std::vector<Eigen::Vector2d> upper_edge_px;   // located, in order
  std::vector<Eigen::Vector2d> fitted_edge_px;  // the fitted curve beside each of them
  std::vector<Eigen::Vector2d> lower_edge_px;   // located; may be empty
  Eigen::Vector2d upper_end_px{0, 0}, lower_end_px{0, 0};
  Eigen::Vector2d pivot_px{0, 0};
  double pivot_sigma_px = 0;
  Eigen::Vector2d axis_px{0, 0};  // unit image direction of +x
  double theta_rad = 0, theta_sigma_rad = 0;
  double unit_per_px = 1;   // for the scale bar
  std::string unit = "mm";  // "px" where no scale is known
  std::string title;        // name, status, warnings
  bool doubtful = false;    // status review: the title bar turns amber
};

// The photograph with edge, curve, pivot, axis, angle and scale bar; below it the upper edge
// straightened along the curve and enlarged across it, and the place where point and curve are
// furthest apart. Returns CV_8UC3; the photograph in it has its longest side between 1000 and 2000
// px. Throws std::invalid_argument where the upper and the fitted edge differ in length or hold
// fewer than two points.
[[nodiscard]] cv::Mat DrawOverlay(const Photo& photo, const Overlay& overlay);

}  // namespace bladecurve
