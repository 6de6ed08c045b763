// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/occluding_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Line = Eigen::Hyperplane<double, 2>;

constexpr double kClearPx = 1.3;  // of a line, beyond its blur
constexpr double kReachPx = 6;    // from a line

// An edge as it runs near the crotch, where it hardly bends, and before; distances from it are
// positive outwards. Of the very first points neighbours are missing.
Line LineNearCrotch(const std::vector<LocatedEdgePoint>& edge) {
  constexpr double kFrom = 0.03, kTo = 0.18;  // of the edge
  const auto at = [&](double share) {
    return edge[static_cast<std::size_t>(share * static_cast<double>(edge.size()))];
  };
  const LocatedEdgePoint from = at(kFrom), to = at(kTo);
  Line line = Line::Through(from.trend_px, to.trend_px);
  if (line.normal().dot(from.normal + to.normal) < 0) line.coeffs() = -line.coeffs();
  return line;
}

bool IsBeside(double off_px) { return std::abs(off_px) > kClearPx && std::abs(off_px) < kReachPx; }

// ln of the light about a junction of a border with the other blade's edge: on the other blade and
// beside it, outside of the border and within, where the inner line is not reached.
struct JunctionLight {
  std::vector<double> blade, ground, blade_within, ground_within;

  [[nodiscard]] bool IsSeen() const {
    constexpr std::size_t kLeast = 6;  // pixels
    return std::min({blade.size(), ground.size(), blade_within.size(), ground_within.size()}) >=
           kLeast;
  }
};

JunctionLight LightAbout(const BladeView& view,
                         const Line& border,
                         const Line& inner,
                         const Line& edge) {
  constexpr double kLeastSine = 0.1;  // between the edges
  constexpr double kDark = 0.002;     // added to the light: noise is no less
  JunctionLight light;
  const double sine = std::abs(Cross(border.normal(), edge.normal()));
  if (sine < kLeastSine) return light;
  const Vector2d junction = border.intersection(edge);
  const double width_px = std::max(0.0, inner.signedDistance(junction));
  const int reach = static_cast<int>((width_px + kReachPx) / sine + 2 * kReachPx);
  const cv::Mat& grey = view.grey();
  const cv::Rect about(
      cv::Point(static_cast<int>(junction.x()) - reach, static_cast<int>(junction.y()) - reach),
      cv::Size(2 * reach, 2 * reach));
  const cv::Rect seen = about & cv::Rect(cv::Point(), grey.size());
  for (int y = seen.y; y < seen.br().y; ++y) {
    for (int x = seen.x; x < seen.br().x; ++x) {
      const Vector2d place(x, y);
      const double off_edge = edge.signedDistance(place);
      const double outside = border.signedDistance(place);
      const bool is_within = outside < -kClearPx && inner.signedDistance(place) > kClearPx;
      if (!IsBeside(off_edge) || !(is_within || (outside > 0 && IsBeside(outside)))) continue;
      std::vector<double>& blade = is_within ? light.blade_within : light.blade;
      std::vector<double>& ground = is_within ? light.ground_within : light.ground;
      const float linear = view.tone().linear[grey.at<uchar>(y, x)];
      (off_edge > 0 ? ground : blade).push_back(std::log(kDark + static_cast<double>(linear)));
    }
  }
  return light;
}

}  // namespace

Occlusion OcclusionUpTo(const std::vector<LocatedEdgePoint>& border,
                        const BladeView& view,
                        const LocatedBlade& inner,
                        const LocatedBlade& other) {
  constexpr double kShows = 0.3;                                  // ln of light
  constexpr double kHidden = 0.3, kSeen = 0.45, kGoesOver = 0.3;  // of the edge's step
  if (border.empty()) return Occlusion::kUntold;
  const JunctionLight light = LightAbout(
      view, LineNearCrotch(border), LineNearCrotch(inner.used), LineNearCrotch(other.used));
  if (!light.IsSeen()) return Occlusion::kUntold;
  const double blade = Median(light.blade), ground = Median(light.ground);
  const double blade_within = Median(light.blade_within);
  const double ground_within = Median(light.ground_within);
  const double step = ground - blade, left = (ground_within - blade_within) / step;
  if (std::abs(step) < kShows) return Occlusion::kUntold;
  if (left > kSeen) return Occlusion::kNone;
  const bool may_be_shadow = ground_within < ground;
  const bool goes_over_blade = std::abs(blade_within - blade) > kGoesOver * std::abs(step);
  const bool hidden = std::abs(left) < kHidden && (!may_be_shadow || goes_over_blade);
  return hidden ? Occlusion::kHidden : Occlusion::kUntold;
}

}  // namespace bladecurve
