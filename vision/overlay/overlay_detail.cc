// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/overlay/overlay_detail.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/overlay/overlay_canvas.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A path walked at constant speed.
class ArcLength {
 public:
  explicit ArcLength(const std::vector<Vector2d>& path) : path_(path), arc_(path.size(), 0.0) {
    for (std::size_t i = 1; i < path.size(); ++i)
      arc_[i] = arc_[i - 1] + (path[i] - path[i - 1]).norm();
  }

  [[nodiscard]] double total() const { return arc_.back(); }
  [[nodiscard]] double At(std::size_t index) const { return arc_[index]; }

  [[nodiscard]] Vector2d PointAt(double arc) const {
    const std::size_t i = Segment(arc);
    const double length = arc_[i + 1] - arc_[i];
    const double share = length > 0 ? (arc - arc_[i]) / length : 0;
    return path_[i] + share * (path_[i + 1] - path_[i]);
  }

  // Unit normal, 90 degrees clockwise as seen from the direction of walking. The chord over a few
  // pixels keeps the noise of single points out of it.
  [[nodiscard]] Vector2d NormalAt(double arc) const {
    const double reach = std::min(10.0, total() / 2);
    const Vector2d chord =
        PointAt(std::min(arc + reach, total())) - PointAt(std::max(arc - reach, 0.0));
    return Vector2d(-chord.y(), chord.x()).normalized();
  }

 private:
  [[nodiscard]] std::size_t Segment(double arc) const {
    const auto after = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc);
    return static_cast<std::size_t>(after - arc_.begin()) - 1;
  }

  const std::vector<Vector2d>& path_;
  std::vector<double> arc_;
};

// Copies grey values into a BGR picture, stretched to the full range: dim photographs show their
// edge too.
void PaintStretched(const cv::Mat1f& grey, cv::Mat& image) {
  double darkest = 0, brightest = 0;
  cv::minMaxLoc(grey, &darkest, &brightest);
  const double gain = 255 / std::max(brightest - darkest, 16.0);  // noise alone is not blown up
  cv::Mat1b stretched;
  grey.convertTo(stretched, CV_8U, gain, -darkest * gain);
  cv::cvtColor(stretched, image, cv::COLOR_GRAY2BGR);
}

void PaintStraightened(const Photo& photo,
                       const ArcLength& curve,
                       double half_band_px,
                       cv::Mat& image) {
  cv::Mat1f grey(image.size());
  for (int column = 0; column < image.cols; ++column) {
    const double arc = curve.total() * column / (image.cols - 1);
    const Vector2d at = curve.PointAt(arc), normal = curve.NormalAt(arc);
    for (int row = 0; row < image.rows; ++row) {
      const double across = half_band_px * (2.0 * row / (image.rows - 1) - 1);
      grey(row, column) = static_cast<float>(GreyAt(photo, at + across * normal));
    }
  }
  PaintStretched(grey, image);
}

void PaintEnlarged(const Photo& photo, const Vector2d& corner_px, double zoom, cv::Mat& image) {
  cv::Mat1f grey(image.size());
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const Vector2d at = corner_px + Vector2d(column + 0.5, row + 0.5) / zoom;
      const Vector2d whole(std::round(at.x()), std::round(at.y()));
      grey(row, column) = static_cast<float>(GreyAt(photo, whole));
    }
  }
  PaintStretched(grey, image);
}

}  // namespace

std::size_t WorstPoint(const Overlay& overlay) {
  std::size_t worst = 0;
  double largest = -1;
  for (std::size_t i = 0; i < overlay.upper_edge_px.size(); ++i) {
    const double distance = (overlay.upper_edge_px[i] - overlay.fitted_edge_px[i]).norm();
    if (distance > largest) {
      largest = distance;
      worst = i;
    }
  }
  return worst;
}

void DrawStraightenedEdge(const Photo& photo,
                          const Overlay& overlay,
                          double half_band_px,
                          cv::Mat image) {
  const ArcLength curve(overlay.fitted_edge_px);
  PaintStraightened(photo, curve, half_band_px, image);
  View view{image};
  const double middle = (image.rows - 1) / 2.0;
  const double across_scale = middle / half_band_px;
  DrawPath(view, {{0, middle}, {image.cols - 1.0, middle}}, kFittedColour, 1);
  for (std::size_t i = 0; i < overlay.upper_edge_px.size(); ++i) {
    const double arc = curve.At(i);
    const double across =
        (overlay.upper_edge_px[i] - overlay.fitted_edge_px[i]).dot(curve.NormalAt(arc));
    const Vector2d at(arc / curve.total() * (image.cols - 1), middle + across * across_scale);
    DrawDot(view, at, 1.5, kLocatedColour);
  }
}

void DrawWorstPlace(const Photo& photo, const Overlay& overlay, double half_px, cv::Mat image) {
  const Vector2d center = overlay.upper_edge_px[WorstPoint(overlay)];
  const double zoom = image.cols / (2 * half_px);
  const Vector2d corner = center - Vector2d::Constant(half_px);
  PaintEnlarged(photo, corner, zoom, image);
  View view{image};
  view.scale *= zoom;
  view.shift = Vector2d::Constant(-0.5) - zoom * corner;
  DrawPath(view, overlay.fitted_edge_px, kFittedColour, 1);
  for (const Vector2d& point : overlay.upper_edge_px) DrawDot(view, point, 2.5, kLocatedColour);
}

}  // namespace bladecurve
