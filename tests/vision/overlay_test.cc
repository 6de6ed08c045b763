// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/overlay/overlay.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "process_folder.h"
#include "vision/photo/png_writer.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kWidth = 1200, kHeight = 900;  // shown as they are, below the title
constexpr double kThetaRad = 0.7;
constexpr double kReachPx = 380;
const cv::Scalar kSheet(140, 120, 100);

// Scissors that point along an axis of the picture, their ends that far from its border.
Overlay Pointing(const Vector2d& axis_px, double from_border_px) {
  const Vector2d middle(0.5 * kWidth, 0.5 * kHeight);
  const double to_border_px = middle.dot(axis_px.cwiseAbs());
  const Vector2d pivot_px = middle + (to_border_px - from_border_px - kReachPx) * axis_px;
  const auto end = [&](double side) -> Vector2d {
    return pivot_px + kReachPx * (Eigen::Rotation2Dd(side * kThetaRad / 2) * axis_px);
  };
  Overlay overlay;
  overlay.pivot_px = pivot_px;
  overlay.pivot_sigma_px = 1;
  overlay.axis_px = axis_px;
  overlay.theta_rad = kThetaRad;
  overlay.theta_sigma_rad = 0.001;
  overlay.upper_end_px = end(-1);
  overlay.lower_end_px = end(1);
  overlay.upper_edge_px = overlay.fitted_edge_px = {pivot_px, overlay.upper_end_px};
  overlay.lower_edge_px = {pivot_px, overlay.lower_end_px};
  overlay.title = "title";
  return overlay;
}

cv::Mat Drawn(const Overlay& overlay) {
  const std::filesystem::path file = ProcessFolder() / "sheet.png";
  WritePng(file, cv::Mat(kHeight, kWidth, CV_8UC3, kSheet));
  const cv::Mat picture = DrawOverlay(Photo::Load(file), overlay);
  int title = 0;
  while (picture.at<cv::Vec3b>(title, 1) != cv::Vec3b(kSheet[0], kSheet[1], kSheet[2])) ++title;
  return picture(cv::Rect(0, title, kWidth, kHeight));
}

// Pixels in the colour of the angle; of all, and between the blades.
struct Written {
  int anywhere = 0, between_blades = 0;
};

Written CountWritten(const cv::Mat& picture, const Overlay& overlay) {
  cv::Mat yellow;
  cv::inRange(picture, cv::Scalar(0, 180, 200), cv::Scalar(90, 255, 255), yellow);
  std::vector<cv::Point> places;
  cv::findNonZero(yellow, places);
  Written written{static_cast<int>(places.size())};
  for (const cv::Point& place : places) {
    const Vector2d from_pivot = Vector2d(place.x, place.y) - overlay.pivot_px;
    const double along = from_pivot.normalized().dot(overlay.axis_px);
    const double reach = from_pivot.norm() / kReachPx;
    if (along > std::cos(0.4 * kThetaRad) && reach > 0.3 && reach < 1) ++written.between_blades;
  }
  return written;
}

TEST(DrawOverlay, WritesTheAngleBesideTheBlades) {
  for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)}) {
    for (const double from_border_px : {30.0, 250.0}) {
      const Overlay overlay = Pointing(axis, from_border_px);
      const Written written = CountWritten(Drawn(overlay), overlay);
      EXPECT_GT(written.anywhere, 300);
      EXPECT_EQ(written.between_blades, 0)
          << axis.transpose() << ", " << from_border_px << " px from the border";
    }
  }
}

}  // namespace
}  // namespace bladecurve
