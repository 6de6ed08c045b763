// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// How well a drawn edge and the photograph of it agree, found without any edge detector.
struct EdgeAgreement {
  double shift_px = std::numeric_limits<double>::quiet_NaN();  // the photograph's edge lies that
                                                               // far out of the blade
  double spread_px =
      std::numeric_limits<double>::quiet_NaN();  // standard deviation of that along the edge
  double blur_px = std::numeric_limits<double>::quiet_NaN();   // of the drawing that agrees best
  double residual = std::numeric_limits<double>::quiet_NaN();  // rms of photograph minus drawing,
                                                               // over the contrast
  int windows = 0;  // stretches of the edge that were compared
};

// Draws blade and background on both sides of `edge_px` (stored pixels, in order), blurred and
// integrated over pixels, with levels and slopes of each window fitted in linear light, and finds
// by how much the drawing must be moved along its normal. Windows that leave the picture or show no
// contrast are left out; none left: the reals stay NaN.
[[nodiscard]] EdgeAgreement CompareDrawnEdge(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const std::vector<Eigen::Vector2d>& edge_px,
                                             bool blade_on_left);

}  // namespace bladecurve
