// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/limb_count.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/image/nearest_pixel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Unit vectors from the pivot to the middles of all that the silhouette shows on the circle about
// it, wholly ahead of the pair, but for what is wider than any blade: a ruler or a card beneath,
// which mostly reaches behind it as well.
std::vector<Vector2d> DirectionsAhead(const cv::Mat& filled,
                                      const Vector2d& pivot,
                                      const Vector2d& bisector,
                                      double radius_px,
                                      double widest_px) {
  constexpr double kAhead = 2.0;                   // rad, to either side of the blades' bisector
  constexpr double kStepPx = 0.5, kNarrowest = 2;  // px; less is a thread, or the mask's raggedness
  const Vector2d across(-bisector.y(), bisector.x());
  const auto direction = [&](double angle) -> Vector2d {
    return std::cos(angle) * bisector + std::sin(angle) * across;
  };
  const double step = kStepPx / radius_px;
  std::vector<Vector2d> directions;
  double from = -kAhead;  // of what the last places lie in
  for (double at = -kAhead; at <= kAhead; at += step) {
    if (IsSetAt(filled, pivot + radius_px * direction(at))) continue;
    const double wide_px = (at - from) * radius_px;
    if (from > -kAhead && wide_px > kNarrowest && wide_px < widest_px)
      directions.push_back(direction(0.5 * (from + at)));
    from = at + step;
  }
  return directions;
}

// Whether one of the directions is within an angle of another, its cosine given.
bool AnyAlong(const Vector2d& limb, const std::vector<Vector2d>& directions, double cosine) {
  return std::any_of(directions.begin(), directions.end(), [&](const Vector2d& direction) {
    return direction.dot(limb) > cosine;
  });
}

}  // namespace

int CountLimbsAhead(const cv::Mat& filled, const BladePair& pair) {
  constexpr double kNear = 0.4;                          // of the shorter blade
  constexpr double kFurther[] = {0.55, 0.7};             // the same
  constexpr double kWidest = 4;                          // times the wider blade's width
  constexpr double kSame = 0.98558, kAlongShank = 0.95;  // cosines: of 0.17 rad, and 0.32
  const Vector2d first = pair.first.tip - pair.pivot, second = pair.second.tip - pair.pivot;
  const Vector2d bisector = (first.normalized() + second.normalized()).normalized();
  const double length_px = std::min(first.norm(), second.norm());
  const double widest_px = kWidest * std::max(pair.first.width, pair.second.width);
  const auto seen_at = [&](double share) {
    return DirectionsAhead(filled, pair.pivot, bisector, share * length_px, widest_px);
  };
  std::vector<Vector2d> limbs = seen_at(kNear);
  for (const double share : kFurther) {
    const std::vector<Vector2d> seen = seen_at(share);
    std::erase_if(limbs, [&](const Vector2d& limb) { return !AnyAlong(limb, seen, kSame); });
  }
  const std::vector<Vector2d> shanks{(pair.shank_first - pair.pivot).normalized(),
                                     (pair.shank_second - pair.pivot).normalized()};
  std::erase_if(limbs, [&](const Vector2d& limb) { return AnyAlong(limb, shanks, kAlongShank); });
  return static_cast<int>(limbs.size());
}

}  // namespace bladecurve
