// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_softness.h"

#include <cmath>
#include <utility>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Typical grey values outside less those inside, both so far off the path.
double TypicalStep(const cv::Mat& grey, const EdgePath& path, double off_px) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vector2d out = path.points[i] + off_px * path.normals[i];
    const Vector2d in = path.points[i] - off_px * path.normals[i];
    if (LiesWithin(grey, out) && LiesWithin(grey, in))
      steps.push_back(Bilinear<uchar>(grey, out) - Bilinear<uchar>(grey, in));
  }
  return steps.empty() ? 0 : Median(std::move(steps));
}

}  // namespace

bool IsBlurredAway(const cv::Mat& grey, const EdgePath& path) {
  // Off the path, px. Of its height at 12 px, a step blurred by 6 px reaches a quarter at 2 px and
  // 0.7 at 6, one blurred by 14 px 0.2 and 0.55; sharp ones aside of the path none or all of it.
  // Light that falls off over the whole picture rises on and on.
  constexpr double kNear = 2, kMiddle = 6, kFar = 12, kFarther = 24;
  constexpr double kLeastGrey = 12;
  constexpr double kSoft = 0.35, kLeastHalfWay = 0.45, kMostHalfWay = 0.85, kRisesOn = 1.7;
  const double far = TypicalStep(grey, path, kFar);
  if (std::abs(far) < kLeastGrey) return false;
  const auto of_far = [&](double off_px) { return TypicalStep(grey, path, off_px) / far; };
  const double half_way = of_far(kMiddle);
  return of_far(kNear) < kSoft && half_way > kLeastHalfWay && half_way < kMostHalfWay &&
         of_far(kFarther) < kRisesOn;
}

}  // namespace bladecurve
