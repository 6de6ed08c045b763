// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/pivot_debug.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kSide = 640;  // px of the drawing

// The part of the photograph that is drawn, and how large.
struct Cutout {
  cv::Rect area;
  double zoom = 1;

  [[nodiscard]] cv::Point At(const Vector2d& p) const {
    return {static_cast<int>(std::lround((p.x() - area.x + 0.5) * zoom)),
            static_cast<int>(std::lround((p.y() - area.y + 0.5) * zoom))};
  }
};

Cutout OverlapOf(const cv::Mat& grey, const Scene& scene) {
  const Vector2d middle = 0.5 * (scene.crotch_px + scene.shank_crotch_px);
  const double half = 0.7 * (scene.crotch_px - scene.shank_crotch_px).norm() + scene.shank_width_px;
  const cv::Rect wanted(static_cast<int>(middle.x() - half),
                        static_cast<int>(middle.y() - half),
                        static_cast<int>(2 * half),
                        static_cast<int>(2 * half));
  const cv::Rect area = wanted & cv::Rect({0, 0}, grey.size());
  return {area, kSide / std::max({1, area.width, area.height})};
}

void DrawEllipse(const Cutout& cutout,
                 const Vector2d& center,
                 const Vector2d& semi_axes_px,
                 double angle_rad,
                 const cv::Scalar& colour,
                 cv::Mat* picture) {
  const cv::Size axes(std::max(1, static_cast<int>(std::lround(cutout.zoom * semi_axes_px.x()))),
                      std::max(1, static_cast<int>(std::lround(cutout.zoom * semi_axes_px.y()))));
  const double angle_deg = angle_rad * 180 / std::numbers::pi;
  cv::ellipse(*picture, cutout.At(center), axes, angle_deg, 0, 360, colour, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat DrawPivot(const cv::Mat& grey, const Scene& scene, const Pivot& pivot) {
  const Cutout cutout = OverlapOf(grey, scene);
  if (cutout.area.empty()) return cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(0));
  cv::Mat picture;
  cv::cvtColor(grey(cutout.area), picture, cv::COLOR_GRAY2BGR);
  cv::resize(picture, picture, {}, cutout.zoom, cutout.zoom, cv::INTER_CUBIC);
  cv::circle(picture, cutout.At(scene.crotch_px), 5, {255, 255, 0}, 1, cv::LINE_AA);
  cv::circle(picture, cutout.At(scene.shank_crotch_px), 5, {0, 128, 255}, 1, cv::LINE_AA);
  cv::drawMarker(
      picture, cutout.At(pivot.geometry_px), {255, 255, 255}, cv::MARKER_TILTED_CROSS, 12);
  if (pivot.screw) {
    DrawEllipse(cutout,
                pivot.screw->center_px,
                {pivot.screw->semi_major_px, pivot.screw->semi_minor_px},
                pivot.screw->angle_rad,
                {0, 255, 0},
                &picture);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread;
  spread.computeDirect(pivot.covariance_px2);
  const Vector2d major = spread.eigenvectors().col(1);
  DrawEllipse(cutout,
              pivot.point_px,
              spread.eigenvalues().cwiseSqrt().reverse(),
              std::atan2(major.y(), major.x()),
              {0, 255, 255},
              &picture);
  std::string label = "pivot from " + pivot.source;
  if (pivot.screw) label += ", evidence " + std::to_string(pivot.screw->evidence).substr(0, 5);
  cv::putText(
      picture, label, {10, 20}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {255, 255, 255}, 1, cv::LINE_AA);
  return picture;
}

}  // namespace bladecurve
