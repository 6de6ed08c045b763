// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/closed_shape.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A section across the silhouette: how much of it is filled, and in how many runs.
struct Section {
  double width = 0;
  int runs = 0;
};

Section SectionAcross(const cv::Mat& filled, const Vector2d& middle, const Vector2d& half_across) {
  Section section;
  const int steps = static_cast<int>(std::ceil(2 * half_across.norm()));
  bool inside = false;
  for (int k = 0; k <= steps; ++k) {
    const Vector2d p = middle + (2.0 * k / std::max(1, steps) - 1) * half_across;
    const cv::Point at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    const bool now = cv::Rect({0, 0}, filled.size()).contains(at) && filled.at<uchar>(at) != 0;
    section.width += now ? 1 : 0;
    section.runs += now && !inside ? 1 : 0;
    inside = now;
  }
  return section;
}

// Sections at equal steps along the longer axis of the box that fits closest.
struct LongBox {
  Vector2d center, half_long, half_short;
};

LongBox BoxAround(const std::vector<cv::Point>& contour) {
  const cv::RotatedRect rect = cv::minAreaRect(contour);
  std::array<cv::Point2f, 4> corners;
  rect.points(corners.data());
  const auto half = [&](int from, int to) -> Vector2d {
    return 0.5 *
           Vector2d(
               corners[static_cast<std::size_t>(to)].x - corners[static_cast<std::size_t>(from)].x,
               corners[static_cast<std::size_t>(to)].y - corners[static_cast<std::size_t>(from)].y);
  };
  LongBox box{{rect.center.x, rect.center.y}, half(0, 1), half(1, 2)};
  if (box.half_long.norm() < box.half_short.norm()) std::swap(box.half_long, box.half_short);
  return box;
}

constexpr int kSections = 40;

std::vector<Section> SectionsAlong(const cv::Mat& filled, const LongBox& box) {
  std::vector<Section> sections;
  for (int k = 0; k < kSections; ++k) {
    const double t = 2 * (k + 0.5) / kSections - 1;
    sections.push_back(SectionAcross(filled, box.center + t * box.half_long, box.half_short));
  }
  return sections;
}

// With the rings in the first third.
bool IsRodWithRings(const std::vector<Section>& sections, double length) {
  constexpr double kRings = 1.9;      // their width over the rod's
  constexpr double kThickest = 0.16;  // width of the rod over the length of all
  constexpr int kRodFrom = kSections * 2 / 5;
  constexpr int kTipFrom = kSections * 19 / 20;
  constexpr int kMostParted = 2;  // sections with a speck or a notch
  std::vector<double> rod;
  int parted = 0;
  for (int k = kRodFrom; k < kSections; ++k) {
    rod.push_back(sections[static_cast<std::size_t>(k)].width);
    parted += sections[static_cast<std::size_t>(k)].runs != 1 ? 1 : 0;
  }
  double rings = 0;
  for (int k = 0; k < kSections / 3; ++k)
    rings = std::max(rings, sections[static_cast<std::size_t>(k)].width);
  const double width = Median(rod);
  const double tip = sections[kTipFrom].width;
  return parted <= kMostParted && rings > kRings * width && width < kThickest * length &&
         tip < width;
}

bool TouchesFrame(const Silhouette& silhouette, const Vector2d& point) {
  const int margin = 4;
  return point.x() < margin || point.y() < margin ||
         point.x() > silhouette.filled.cols - 1 - margin ||
         point.y() > silhouette.filled.rows - 1 - margin;
}

}  // namespace

bool LooksClosed(const Silhouette& silhouette) {
  const LongBox box = BoxAround(silhouette.contour);
  std::vector<Section> sections = SectionsAlong(silhouette.filled, box);
  const double length = 2 * box.half_long.norm();
  if (IsRodWithRings(sections, length))
    return !TouchesFrame(silhouette, box.center + box.half_long);
  std::reverse(sections.begin(), sections.end());
  return IsRodWithRings(sections, length) && !TouchesFrame(silhouette, box.center - box.half_long);
}

}  // namespace bladecurve
