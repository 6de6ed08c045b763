// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/closed_shape.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/image/nearest_pixel.h"
#include "vision/image/principal_axis.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
    const bool now = IsSetAt(filled, middle + (2.0 * k / std::max(1, steps) - 1) * half_across);
    section.width += now ? 1 : 0;
    section.runs += now && !inside ? 1 : 0;
    inside = now;
  }
  return section;
}

// A box along the principal axis of the silhouette.
struct LongBox {
  Vector2d center, half_long, half_short;
};

LongBox BoxAround(const std::vector<cv::Point>& contour) {
  const Vector2d along = PrincipalAxis(cv::moments(contour));
  const Vector2d across(-along.y(), along.x());
  Vector2d low(kInfinity, kInfinity);
  Vector2d high = -low;
  for (const cv::Point& point : contour) {
    const Vector2d p(point.x, point.y);
    const Vector2d q(p.dot(along), p.dot(across));
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  const Vector2d middle = 0.5 * (low + high);
  const Vector2d half = 0.5 * (high - low);
  return {middle.x() * along + middle.y() * across, half.x() * along, half.y() * across};
}

constexpr int kSections = 40;

// At equal steps along the longer axis.
std::vector<Section> SectionsAlong(const cv::Mat& filled, const LongBox& box) {
  std::vector<Section> sections;
  for (int k = 0; k < kSections; ++k) {
    const double t = 2 * (k + 0.5) / kSections - 1;
    sections.push_back(SectionAcross(filled, box.center + t * box.half_long, box.half_short));
  }
  return sections;
}

// The widest of the first third of the sections, and the length over which they are wide.
struct RingEnd {
  double width = 0, length = 0;
};

RingEnd MeasureRings(const std::vector<Section>& sections, double length, double rod_width) {
  constexpr double kWide = 1.5;  // of the rod
  RingEnd rings;
  for (int k = 0; k < kSections / 3; ++k) {
    const double width = sections[static_cast<std::size_t>(k)].width;
    rings.width = std::max(rings.width, width);
    if (width > kWide * rod_width) rings.length += length / kSections;
  }
  return rings;
}

// With two rings side by side in the first third: a single shank has one, longer than wide.
bool IsRodWithRings(const std::vector<Section>& sections, double length) {
  constexpr double kRings = 1.9;       // their width over the rod's
  constexpr double kSideBySide = 1.1;  // their width over their length
  constexpr double kThickest = 0.16;   // width of the rod over the length of all
  constexpr int kRodFrom = kSections * 2 / 5;
  constexpr int kTipFrom = kSections * 19 / 20;
  constexpr int kMostParted = 2;  // sections with a speck or a notch
  std::vector<double> rod;
  int parted = 0;
  for (int k = kRodFrom; k < kSections; ++k) {
    rod.push_back(sections[static_cast<std::size_t>(k)].width);
    parted += sections[static_cast<std::size_t>(k)].runs != 1 ? 1 : 0;
  }
  const double width = Median(rod);
  const RingEnd rings = MeasureRings(sections, length, width);
  return parted <= kMostParted && rings.width > kRings * width &&
         rings.width > kSideBySide * rings.length && width < kThickest * length &&
         sections[kTipFrom].width < width;
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
