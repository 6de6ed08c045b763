// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/touching_handles.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/image/contour_area.h"
#include "vision/image/principal_axis.h"
#include "vision/scene/limbs.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A hole of the mask, along its principal axis.
struct SlenderHole {
  std::vector<cv::Point> contour;
  Vector2d axis = Vector2d::Zero();
  double length_px = 0;
};

// std::nullopt for one that is nearly round, as those of rings are.
std::optional<SlenderHole> AsSlender(std::vector<cv::Point> contour) {
  constexpr double kSlender = 1.6;  // length over width
  const cv::Moments m = cv::moments(contour);
  if (m.m00 <= 0) return std::nullopt;
  const double mean = 0.5 * (m.mu20 + m.mu02);
  const double half_difference = std::hypot(0.5 * (m.mu20 - m.mu02), m.mu11);
  const double longest = mean + half_difference, shortest = mean - half_difference;
  if (longest < kSlender * kSlender * shortest) return std::nullopt;
  const double length_px = std::sqrt(12 * longest / m.m00);  // as of a rectangle
  return SlenderHole{std::move(contour), PrincipalAxis(m), length_px};
}

std::vector<SlenderHole> SlenderHolesOf(const cv::Mat& mask, const Silhouette& silhouette) {
  constexpr double kLeast = 0.002;  // of the silhouette's area
  cv::Mat open = silhouette.filled & ~mask;
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(open, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<SlenderHole> holes;
  for (auto& contour : contours) {
    if (PixelsWithin(contour) < kLeast * silhouette.area_px) continue;
    if (auto hole = AsSlender(std::move(contour))) holes.push_back(*std::move(hole));
  }
  return holes;
}

// The shortest way from an inlet to a hole, if it goes on along the hole.
std::optional<cv::Point> NearestInLine(const SlenderHole& hole, const cv::Point& inlet) {
  constexpr double kInLine = 0.85;  // cosine
  const auto off = [&](const cv::Point& p) { return cv::norm(p - inlet); };
  const cv::Point nearest = *std::min_element(
      hole.contour.begin(), hole.contour.end(), [&](const cv::Point& a, const cv::Point& b) {
        return off(a) < off(b);
      });
  const Vector2d way(nearest.x - inlet.x, nearest.y - inlet.y);
  if (way.norm() > hole.length_px) return std::nullopt;
  if (std::abs(way.dot(hole.axis)) < kInLine * way.norm()) return std::nullopt;
  return nearest;
}

// Its largest part, if that is long enough to be scissors.
std::vector<Silhouette> Opened(const Silhouette& silhouette,
                               const SlenderHole& hole,
                               const cv::Point& from,
                               const cv::Point& to) {
  constexpr int kCutPx = 3;
  cv::Mat filled = silhouette.filled.clone();
  cv::drawContours(filled, std::vector<std::vector<cv::Point>>{hole.contour}, 0, 0, cv::FILLED);
  cv::line(filled, from, to, 0, kCutPx);
  return FindSilhouettes(filled, 1);
}

}  // namespace

std::vector<Silhouette> WithHandlesParted(const cv::Mat& mask, const Silhouette& silhouette) {
  constexpr std::size_t kMost = 4, kMostHoles = 3;  // ragged masks have more
  const std::vector<SlenderHole> holes = SlenderHolesOf(mask, silhouette);
  if (holes.empty() || holes.size() > kMostHoles) return {};
  const std::vector<Inlet> inlets = FindInlets(silhouette.contour);
  std::vector<Silhouette> parted;
  for (const SlenderHole& hole : holes) {
    for (const Inlet& inlet : inlets) {
      const cv::Point& from = silhouette.contour[static_cast<std::size_t>(inlet.far)];
      const auto to = NearestInLine(hole, from);
      if (!to || parted.size() == kMost) continue;
      std::ranges::move(Opened(silhouette, hole, from, *to), std::back_inserter(parted));
    }
  }
  return parted;
}

}  // namespace bladecurve
