// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/finger_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace bladecurve {
namespace {

using Contour = std::vector<cv::Point>;

// Whether a hole is the ellipse that fits it best, and none that is too long for a ring.
bool IsEllipse(const Contour& hole, const cv::RotatedRect& ellipse) {
  constexpr double kLongest = 1.9;                // ratio of the axes
  constexpr double kArea = 0.07, kRagged = 0.05;  // share of the area; of the radius, mean
  const double a = 0.5 * ellipse.size.width, b = 0.5 * ellipse.size.height;
  if (std::max(a, b) > kLongest * std::min(a, b)) return false;
  if (std::abs(cv::contourArea(hole) / (std::numbers::pi * a * b) - 1) > kArea) return false;
  const double angle = ellipse.angle * std::numbers::pi / 180;
  double off = 0;
  for (const cv::Point& at : hole) {
    const cv::Point2d from = cv::Point2d(at) - cv::Point2d(ellipse.center);
    const double along = from.x * std::cos(angle) + from.y * std::sin(angle);
    const double across = from.y * std::cos(angle) - from.x * std::sin(angle);
    off += std::abs(std::hypot(along / a, across / b) - 1);
  }
  return off < kRagged * static_cast<double>(hole.size());
}

// Whether the mask ends not far beyond a place of a hole's border, going outwards.
bool IsWalled(const cv::Mat& mask,
              const cv::Point& place,
              const cv::Point2d& outwards,
              double thickest_px) {
  const cv::Rect picture({0, 0}, mask.size());
  for (double beyond = 2; beyond < thickest_px; ++beyond) {
    const cv::Point at = cv::Point2d(place) + beyond * outwards;
    if (!picture.contains(at)) return false;
    if (mask.at<uchar>(at) == 0) return true;
  }
  return false;
}

struct Ring {
  cv::Point2d center;
  double diameter = 0;  // of the hole
};

// Of a hole's border, the share beyond which there is a wall; shanks join it somewhere.
double WalledShare(const cv::Mat& mask, const Contour& hole, const Ring& ring) {
  constexpr double kThickest = 0.6;  // of the diameter
  constexpr std::size_t kStride = 4;
  int walled = 0, places = 0;
  for (std::size_t i = 0; i < hole.size(); i += kStride, ++places) {
    const cv::Point2d from = cv::Point2d(hole[i]) - ring.center;
    walled +=
        IsWalled(mask, hole[i], from / std::max(1.0, cv::norm(from)), kThickest * ring.diameter);
  }
  return static_cast<double>(walled) / std::max(1, places);
}

// The ring about a hole, if it is one.
std::optional<Ring> RingAbout(const cv::Mat& mask, const Contour& hole) {
  constexpr double kSmallest = 0.03, kLargest = 0.25;  // of the picture's longer side, diameters
  constexpr double kWalled = 0.7;
  constexpr std::size_t kFewest = 20;  // places on the border
  if (hole.size() < kFewest) return std::nullopt;
  const double side_px = std::max(mask.cols, mask.rows);
  const double diameter = std::sqrt(4 / std::numbers::pi * cv::contourArea(hole));
  if (diameter < kSmallest * side_px || diameter > kLargest * side_px) return std::nullopt;
  const cv::RotatedRect ellipse = cv::fitEllipse(hole);
  const Ring ring{cv::Point2d(ellipse.center), diameter};
  const bool is_ring = IsEllipse(hole, ellipse) && WalledShare(mask, hole, ring) > kWalled;
  return is_ring ? std::optional(ring) : std::nullopt;
}

// Whether both are borders of one: the ridge of a round one may look like its ground.
bool AreOne(const Ring& a, const Ring& b) {
  return cv::norm(a.center - b.center) < 0.5 * std::min(a.diameter, b.diameter);
}

std::vector<Ring> RingsIn(const cv::Mat& mask) {
  std::vector<Contour> contours;
  std::vector<cv::Vec4i> tree;
  cv::findContours(mask, contours, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const bool is_hole = tree[i][3] >= 0;
    const auto ring = is_hole ? RingAbout(mask, contours[i]) : std::nullopt;
    const auto is_same = [&](const Ring& other) { return AreOne(*ring, other); };
    if (ring && std::none_of(rings.begin(), rings.end(), is_same)) rings.push_back(*ring);
  }
  return rings;
}

}  // namespace

int CountFingerRings(const cv::Mat& mask) {
  constexpr double kAlike = 1.7;  // ratio of diameters
  const std::vector<Ring> rings = RingsIn(mask);
  std::ptrdiff_t most = 0;
  for (const Ring& smallest : rings) {
    const auto alike = [&](const Ring& ring) {
      return ring.diameter >= smallest.diameter && ring.diameter < kAlike * smallest.diameter;
    };
    most = std::max(most, std::count_if(rings.begin(), rings.end(), alike));
  }
  return static_cast<int>(most);
}

}  // namespace bladecurve
