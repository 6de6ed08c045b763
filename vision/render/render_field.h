// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/render/render_coverage.h"

namespace bladecurve::render {

// A value that changes slowly over the picture: one for each step_px, joined linearly. Empty: 0
// everywhere.
struct CoarseField {
  cv::Mat1f values;
  double step_px = 1;
  [[nodiscard]] double At(const Eigen::Vector2d& px) const;
};

// Which share of a wide light the polygons (in pixels) hide: their coverage, blurred by a Gaussian
// of blur_px.
[[nodiscard]] CoarseField ShadowField(const std::vector<Polygon>& polygons,
                                      const cv::Size& picture,
                                      double blur_px);

}  // namespace bladecurve::render
