// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_field.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bladecurve::render {

double CoarseField::At(const Eigen::Vector2d& px) const {
  if (values.empty()) return 0;
  const double x = std::clamp((px.x() + 0.5) / step_px - 0.5, 0.0, values.cols - 1.001);
  const double y = std::clamp((px.y() + 0.5) / step_px - 0.5, 0.0, values.rows - 1.001);
  const int c = static_cast<int>(x), r = static_cast<int>(y);
  const double fx = x - c, fy = y - r;
  return (values(r, c) * (1 - fx) + values(r, c + 1) * fx) * (1 - fy) +
         (values(r + 1, c) * (1 - fx) + values(r + 1, c + 1) * fx) * fy;
}

CoarseField ShadowField(const std::vector<Polygon>& polygons,
                        const cv::Size& picture,
                        double blur_px) {
  constexpr double kSamplesPerSigma = 2, kCoarsest_px = 16, kSharpest = 0.3;
  CoarseField field;
  field.step_px = std::clamp(std::floor(blur_px / kSamplesPerSigma), 1.0, kCoarsest_px);
  const CoverageGrid grid{.step_px = field.step_px,
                          .cols = static_cast<int>(picture.width / field.step_px) + 2,
                          .rows = static_cast<int>(picture.height / field.step_px) + 2};
  field.values = cv::Mat1f::zeros(grid.rows, grid.cols);
  for (const Polygon& polygon : polygons) {
    const cv::Mat1f coverage = PolygonCoverage(polygon, grid);
    field.values = cv::Mat1f(cv::max(field.values, coverage));
  }
  cv::GaussianBlur(
      field.values, field.values, cv::Size(), std::max(blur_px / field.step_px, kSharpest));
  return field;
}

}  // namespace bladecurve::render
