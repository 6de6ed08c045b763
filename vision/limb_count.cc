// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/limb_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vision/nearest_pixel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Directions from the blades' bisector, rad, of the middles of all that the silhouette shows on the
// circle about the pivot.
std::vector<double> DirectionsAhead(const cv::Mat& filled,
                                    const Vector2d& pivot,
                                    const Vector2d& bisector,
                                    double radius_px) {
  constexpr double kAhead = 2.0;                   // rad
  constexpr double kStepPx = 0.5, kNarrowest = 2;  // px; less is a thread, or the mask's raggedness
  const Vector2d across(-bisector.y(), bisector.x());
  const double step = kStepPx / radius_px;
  std::vector<double> directions;
  double from = -kAhead;  // of what the last places lie in
  const auto end_at = [&](double to) {
    if ((to - from) * radius_px > kNarrowest) directions.push_back(0.5 * (from + to));
  };
  for (double at = -kAhead; at <= kAhead; at += step) {
    const Vector2d place = pivot + radius_px * (std::cos(at) * bisector + std::sin(at) * across);
    if (IsSetAt(filled, place)) continue;
    end_at(at);
    from = at + step;
  }
  end_at(kAhead);
  return directions;
}

}  // namespace

int CountLimbsAhead(const cv::Mat& filled, const BladePair& pair) {
  constexpr std::array kShares = {0.4, 0.55, 0.7};  // of the shorter blade
  constexpr double kSame = 0.17;                    // rad
  constexpr double kAlongShank = 0.95;              // cosine
  const Vector2d first = pair.first.tip - pair.pivot, second = pair.second.tip - pair.pivot;
  const Vector2d bisector = (first.normalized() + second.normalized()).normalized();
  const double length_px = std::min(first.norm(), second.norm());
  const Vector2d across(-bisector.y(), bisector.x());
  std::vector<double> limbs;
  for (const double share : kShares) {
    const std::vector<double> seen =
        DirectionsAhead(filled, pair.pivot, bisector, share * length_px);
    if (share == kShares.front()) {
      limbs = seen;
      continue;
    }
    std::erase_if(limbs, [&](double limb) {
      return std::none_of(
          seen.begin(), seen.end(), [&](double at) { return std::abs(at - limb) < kSame; });
    });
  }
  const auto is_shank = [&](double limb) {
    const Vector2d direction = std::cos(limb) * bisector + std::sin(limb) * across;
    return std::max(direction.dot((pair.shank_first - pair.pivot).normalized()),
                    direction.dot((pair.shank_second - pair.pivot).normalized())) > kAlongShank;
  };
  std::erase_if(limbs, is_shank);
  return static_cast<int>(limbs.size());
}

}  // namespace bladecurve
