// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/lost_joint.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"
#include "vision/scene/limbs.h"

namespace bladecurve {
namespace {

using Colour = Eigen::Vector3d;
using Eigen::Vector2d;

// Mean over the middle half of the gap across a place in it, the one shank as far as the other
// where that has been lost.
Colour ColourOfGap(const Candidate& found, const Vector2d& place, const Vector2d& across) {
  constexpr double kFurther = 2;
  const double most = found.mask.cols;
  const auto reach = [&](double sign) {
    double d = 0;
    while (d < most && !IsSetAt(found.mask, place + sign * d * across)) d += 0.5;
    return d;
  };
  double up = reach(1), down = reach(-1);
  if (up > kFurther * down) up = down;
  if (down > kFurther * up) down = up;
  const double middle = 0.5 * (up - down), half = 0.25 * (up + down);
  Colour sum = Colour::Zero();
  int count = 0;
  for (double d = middle - half; d <= middle + half; d += 1, ++count)
    sum += found.at->ColourAt(place + d * across);
  return sum / std::max(1, count);
}

// What lies between the shanks, further back than the joint.
struct Ground {
  Colour colour;
  double noise = 0;
};

Ground GroundOf(std::span<const Colour> gap) {
  Ground ground;
  const auto median_of = [&](const auto& value) {
    std::vector<double> values;
    std::ranges::transform(gap, std::back_inserter(values), value);
    return Median(values);
  };
  for (int c = 0; c < 3; ++c) ground.colour[c] = median_of([&](const Colour& p) { return p[c]; });
  ground.noise = median_of([&](const Colour& p) { return (p - ground.colour).norm(); });
  return ground;
}

// Whether the mask shows no more of a shank than a rim, from a place behind the joint on as far
// again: those of scissors are about as wide as the blades.
bool ShowsRimAlone(const Candidate& found, double behind) {
  constexpr double kRim = 0.6;  // of the blades' width
  const BladePair& pair = found.pair;
  const auto width = [&](const Vector2d& end) {
    const double length = (end - *pair.shank_crotch).norm();
    std::vector<double> widths;
    for (const double times : {1.0, 1.25, 1.5, 1.75, 2.0}) {
      const double share = std::min(1.0, times * behind / length);
      widths.push_back(WidthAcross(found.mask, *pair.shank_crotch, end, share));
    }
    return Median(widths);
  };
  return std::min(width(pair.shank_first), width(pair.shank_second)) <
         kRim * std::min(pair.first.width, pair.second.width);
}

// Behind a crotch from which on a shank shows by its rim alone: the furthest place between the
// shanks that is unlike the ground further back.
std::optional<Vector2d> EndBehindRims(const Candidate& found) {
  constexpr double kSure = 0.75;                      // quality
  constexpr double kBeforeRing = 0.6;                 // of the way to the longer shank's end
  constexpr double kOfBlades = 0.3, kNoise = 6;       // of the edges' transition; of the ground's
  constexpr double kPlainly = 0.25, kFurthest = 2.5;  // of the joint that the mask shows
  constexpr std::size_t kFewest = 8;                  // places
  const BladePair& pair = found.pair;
  if (!pair.shank_crotch || pair.quality < kSure) return std::nullopt;
  const Vector2d back = *pair.shank_crotch;
  const Vector2d first = pair.shank_first - back, second = pair.shank_second - back;
  const Vector2d along = (first.normalized() + second.normalized()).normalized();
  const Vector2d across(-along.y(), along.x());
  std::vector<Colour> gap;
  for (double d = 1; d < kBeforeRing * std::max(first.dot(along), second.dot(along)); d += 1)
    gap.push_back(ColourOfGap(found, back + d * along, across));
  if (gap.size() < kFewest) return std::nullopt;
  const Ground ground = GroundOf(std::span(gap).subspan(gap.size() / 2));
  const double least = std::max(kOfBlades * found.strength, kNoise * ground.noise);
  const double joint = (pair.crotch - back).norm();
  const auto unlike = [&](const Colour& colour) { return (colour - ground.colour).norm() > least; };
  const auto last = std::find_if(gap.rbegin(), gap.rend(), unlike);
  const double behind = static_cast<double>(std::distance(last, gap.rend()));
  if (behind < kPlainly * joint || behind > kFurthest * joint || !ShowsRimAlone(found, behind))
    return std::nullopt;
  return back + behind * along;
}

// Of two members as wide as the blades, along the axis: the diagonal of the rhombus in which they
// cross.
double CrossingLength(const BladePair& pair) {
  constexpr double kLeastSine = 0.01;
  const Vector2d first = (pair.first.tip - pair.crotch).normalized();
  const Vector2d second = (pair.second.tip - pair.crotch).normalized();
  const double sin_half_opening = 0.5 * (first - second).norm();
  return std::min(pair.first.width, pair.second.width) / std::max(kLeastSine, sin_half_opening);
}

}  // namespace

std::optional<Vector2d> EndOfLostJoint(const Candidate& found) {
  // Of the crossing's length. Members are wider than blades half way to their tips: of scissors of
  // which nothing is lost, photographed or rendered, 95 % have 1.4 and more, half have 2.
  constexpr double kLost = 0.9, kUsual = 2;
  const BladePair& pair = found.pair;
  if (!pair.shank_crotch) return std::nullopt;
  const Vector2d joint = *pair.shank_crotch - pair.crotch;
  const double crossing = CrossingLength(pair);
  if (joint.norm() < kLost * crossing) return pair.crotch + kUsual * crossing * joint.normalized();
  return EndBehindRims(found);
}

}  // namespace bladecurve
