// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/overlay/overlay_canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// OpenCV draws to sub-pixel with coordinates in 1/16 px.
constexpr int kFixedBits = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kCapitalHeight = 21;  // of kFont at scale 1, px

cv::Point Fixed(const Vector2d& at) {
  // Far outside the picture the integers would overflow; nothing is seen there.
  const Vector2d held = at.cwiseMax(-1e5).cwiseMin(1e5) * (1 << kFixedBits);
  return {static_cast<int>(std::lround(held.x())), static_cast<int>(std::lround(held.y()))};
}

int Thickness(double width) { return std::max(1, static_cast<int>(std::lround(width))); }

void Line(
    View& view, const Vector2d& from, const Vector2d& to, const cv::Scalar& colour, double width) {
  cv::line(view.image, Fixed(from), Fixed(to), colour, Thickness(width), cv::LINE_AA, kFixedBits);
}

}  // namespace

Vector2d View::ViewFromPhoto(const Vector2d& displayed_px) const {
  return scale * displayed_px + shift;
}

void DrawPath(View& view,
              const std::vector<Vector2d>& path_px,
              const cv::Scalar& colour,
              double width) {
  std::vector<cv::Point> points;
  points.reserve(path_px.size());
  for (const Vector2d& point : path_px) points.push_back(Fixed(view.ViewFromPhoto(point)));
  const int thickness = Thickness(width * view.stroke);
  cv::polylines(view.image, points, false, kHaloColour, thickness + 2, cv::LINE_AA, kFixedBits);
  cv::polylines(view.image, points, false, colour, thickness, cv::LINE_AA, kFixedBits);
}

void DrawDashed(View& view,
                const Vector2d& from_px,
                const Vector2d& to_px,
                const cv::Scalar& colour) {
  const Vector2d from = view.ViewFromPhoto(from_px), to = view.ViewFromPhoto(to_px);
  const double length = (to - from).norm();
  const double dash = 12 * view.stroke;
  for (double at = 0; at < length; at += 2 * dash) {
    const Vector2d begin = from + (to - from) * (at / length);
    const Vector2d end = from + (to - from) * (std::min(at + dash, length) / length);
    Line(view, begin, end, kHaloColour, view.stroke + 2);
    Line(view, begin, end, colour, view.stroke);
  }
}

void DrawDot(View& view, const Vector2d& at_px, double radius, const cv::Scalar& colour) {
  const cv::Point center = Fixed(view.ViewFromPhoto(at_px));
  const int fixed_radius = static_cast<int>(std::lround(radius * (1 << kFixedBits)));
  cv::circle(view.image, center, fixed_radius, colour, cv::FILLED, cv::LINE_AA, kFixedBits);
}

void DrawText(View& view,
              const std::string& text,
              const Vector2d& at,
              double height,
              const cv::Scalar& colour) {
  const cv::Point place(static_cast<int>(std::lround(at.x())),
                        static_cast<int>(std::lround(at.y())));
  const double font_scale = height / kCapitalHeight;
  const int thickness = Thickness(height / 11);
  cv::putText(view.image, text, place, kFont, font_scale, kHaloColour, thickness + 3, cv::LINE_AA);
  cv::putText(view.image, text, place, kFont, font_scale, colour, thickness, cv::LINE_AA);
}

double TextWidth(const std::string& text, double height) {
  int base_line = 0;
  return cv::getTextSize(text, kFont, height / kCapitalHeight, Thickness(height / 11), &base_line)
      .width;
}

double GreyAt(const Photo& photo, const Vector2d& displayed_px) {
  const cv::Mat& grey = photo.grey();
  const Vector2d stored = photo.StoredFromDisplayed(displayed_px);
  const double x = std::clamp(stored.x(), 0.0, grey.cols - 1.0);
  const double y = std::clamp(stored.y(), 0.0, grey.rows - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(grey.cols - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(grey.rows - 2, 0));
  const int right = std::min(column + 1, grey.cols - 1), below = std::min(row + 1, grey.rows - 1);
  const double fx = x - column, fy = y - row;
  const double upper = (1 - fx) * grey.at<uchar>(row, column) + fx * grey.at<uchar>(row, right);
  const double lower = (1 - fx) * grey.at<uchar>(below, column) + fx * grey.at<uchar>(below, right);
  return (1 - fy) * upper + fy * lower;
}

}  // namespace bladecurve
