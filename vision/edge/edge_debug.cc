// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_debug.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kShown = 24;    // px shown to either side of the edge
constexpr int kAcross = 8;    // picture rows a px
constexpr int kProfiles = 8;  // curves below
constexpr int kHeight = 220;  // of their plots
constexpr int kGap = 12;      // between them
const cv::Scalar kGreen(80, 220, 80), kRed(60, 60, 255), kBlue(255, 160, 60), kYellow(0, 230, 255),
    kInk(230, 230, 230), kPaper(30, 30, 30);

// The straightened picture: a column for each point, the trend in the middle row.
struct StraightStrip {
  const LocatedEdge& edge;
  cv::Mat grey;     // CV_8UC1, not yet enlarged
  int columns = 1;  // of the picture for one point

  [[nodiscard]] static int RowAt(double across_px) {
    return static_cast<int>(std::lround((across_px + kShown) * kAcross));
  }
  [[nodiscard]] int ColumnAt(std::size_t point) const {
    return static_cast<int>(point) * columns + columns / 2;
  }
  // Of a point of the photograph, against the trend at the nearest of the edge's points.
  [[nodiscard]] cv::Point PlaceOf(const Vector2d& px) const {
    const std::size_t nearest = NearestPoint(edge, px);
    const LocatedEdgePoint& point = edge.points[nearest];
    return {ColumnAt(nearest), RowAt(point.normal.dot(px - point.trend_px))};
  }
};

StraightStrip Straighten(const cv::Mat& grey, const LocatedEdge& edge) {
  constexpr int kWidest = 1600;  // columns of a picture that fits a screen
  const int count = static_cast<int>(edge.points.size()), rows = 2 * kShown * kAcross + 1;
  cv::Mat x(rows, count, CV_32F), y(rows, count, CV_32F);
  for (int column = 0; column < count; ++column) {
    const LocatedEdgePoint& point = edge.points[static_cast<std::size_t>(column)];
    for (int row = 0; row < rows; ++row) {
      const double across = static_cast<double>(row) / kAcross - kShown;
      const Vector2d at = point.trend_px + across * point.normal;
      x.at<float>(row, column) = static_cast<float>(at.x());
      y.at<float>(row, column) = static_cast<float>(at.y());
    }
  }
  StraightStrip strip{edge, {}, std::clamp(kWidest / std::max(count, 1), 1, kAcross)};
  cv::remap(grey, strip.grey, x, y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return strip;
}

void DrawPoints(const StraightStrip& strip, cv::Mat* picture) {
  const std::vector<LocatedEdgePoint>& points = strip.edge.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point trend(strip.ColumnAt(i), StraightStrip::RowAt(0));
    cv::circle(*picture, trend, 0, kBlue, cv::FILLED);
    const double off = points[i].normal.dot(points[i].point_px - points[i].trend_px);
    const cv::Point at(trend.x, StraightStrip::RowAt(std::clamp<double>(off, -kShown, kShown)));
    cv::circle(*picture, at, 1, points[i].inlier ? kGreen : kRed, cv::FILLED);
  }
  for (const Vector2d& p : strip.edge.rival_path_px)
    cv::circle(*picture, strip.PlaceOf(p), 0, kYellow, cv::FILLED);
}

// Mean grey values of the columns [first, last) as a curve, dark at the bottom.
cv::Mat PlotProfile(const cv::Mat& strip, int first, int last, int width) {
  cv::Mat plot(kHeight, width, CV_8UC3, kPaper), mean;
  cv::reduce(strip.colRange(first, last), mean, 1, cv::REDUCE_AVG, CV_32F);
  std::vector<cv::Point> curve;
  for (int row = 0; row < mean.rows; ++row) {
    curve.emplace_back(
        row * (width - 1) / std::max(mean.rows - 1, 1),
        kHeight - 1 - static_cast<int>(mean.at<float>(row, 0) * (kHeight - 1) / 255));
  }
  cv::line(plot, {width / 2, 0}, {width / 2, kHeight - 1}, kBlue);
  cv::polylines(plot, curve, false, kInk, 1, cv::LINE_AA);
  return plot;
}

cv::Mat PlotProfiles(const cv::Mat& strip, int width) {
  const int each = (width - (kProfiles - 1) * kGap) / kProfiles;
  cv::Mat plots(kHeight, width, CV_8UC3, cv::Scalar::all(0));
  for (int k = 0; k < kProfiles; ++k) {
    const int first = k * strip.cols / kProfiles;
    const int last = std::max((k + 1) * strip.cols / kProfiles, first + 1);
    PlotProfile(strip, first, last, each)
        .copyTo(plots(cv::Rect(k * (each + kGap), 0, each, kHeight)));
  }
  return plots;
}

cv::Mat Caption(const LocatedEdge& edge, int width) {
  const std::string text =
      cv::format("blur %.2f px, ambiguity %.2f, common sigma %.2f px, overexposed %.2f",
                 edge.blur_px,
                 edge.ambiguity,
                 edge.common_sigma_px,
                 edge.overexposed);
  cv::Mat caption(30, width, CV_8UC3, kPaper);
  cv::putText(caption, text, {8, 21}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1, cv::LINE_AA);
  return caption;
}

}  // namespace

cv::Mat DrawEdge(const cv::Mat& grey, const LocatedEdge& edge) {
  constexpr int kNarrowest = 800;  // columns; less does not hold the curves
  const StraightStrip strip = Straighten(grey, edge);
  cv::Mat picture;
  cv::resize(strip.grey, picture, {}, strip.columns, 1, cv::INTER_NEAREST);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  DrawPoints(strip, &picture);
  const int missing = std::max(kNarrowest - picture.cols, 0);
  cv::copyMakeBorder(picture, picture, 0, 0, 0, missing, cv::BORDER_CONSTANT);
  cv::vconcat(
      std::vector<cv::Mat>{
          Caption(edge, picture.cols), picture, PlotProfiles(strip.grey, picture.cols)},
      picture);
  return picture;
}

}  // namespace bladecurve
