// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/scale_debug.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace bladecurve {

cv::Mat DrawMarkers(const cv::Mat& grey, const std::vector<SeenMarker>& markers) {
  constexpr double kLongSide = 1200;  // px
  const double zoom = std::min(1.0, kLongSide / std::max(grey.cols, grey.rows));
  const cv::Size size(std::max(1, static_cast<int>(std::lround(zoom * grey.cols))),
                      std::max(1, static_cast<int>(std::lround(zoom * grey.rows))));
  cv::Mat picture;
  cv::resize(grey, picture, size, 0, 0, cv::INTER_AREA);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  for (const SeenMarker& marker : markers) {
    const cv::Scalar colour =
        std::isfinite(marker.corner_sigma_px) ? cv::Scalar(0, 200, 0) : cv::Scalar(0, 0, 255);
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& p : marker.corners_px)
      corners.emplace_back(static_cast<int>(std::lround((p.x() + 0.5) * zoom)),
                           static_cast<int>(std::lround((p.y() + 0.5) * zoom)));
    cv::polylines(picture, corners, true, colour, 2, cv::LINE_AA);
    cv::circle(picture, corners.front(), 4, colour, cv::FILLED, cv::LINE_AA);
    cv::putText(picture,
                std::to_string(marker.id),
                0.5 * (corners[0] + corners[2]),
                cv::FONT_HERSHEY_SIMPLEX,
                1,
                colour,
                2,
                cv::LINE_AA);
  }
  return picture;
}

}  // namespace bladecurve
