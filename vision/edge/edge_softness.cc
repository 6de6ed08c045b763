// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_softness.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
  // Off the path, px, and the share of the step at kFar that a step in the path, blurred by 5 to 15
  // px, reaches there. A sharp step aside of the path reaches none of it or all.
  constexpr double kFar = 12, kLeastGrey = 12;
  struct Reached {
    double off_px, least, most;
  };
  constexpr Reached kBlurred[] = {{2, 0.05, 0.35}, {4, 0.2, 0.65}, {6, 0.4, 0.85}};
  constexpr double kFarther = 24, kRisesOn = 1.7;  // light that falls off all over the picture
  const double far = TypicalStep(grey, path, kFar);
  if (std::abs(far) < kLeastGrey) return false;
  const auto of_far = [&](double off_px) { return TypicalStep(grey, path, off_px) / far; };
  return std::all_of(std::begin(kBlurred),
                     std::end(kBlurred),
                     [&](const Reached& reached) {
                       const double share = of_far(reached.off_px);
                       return share > reached.least && share < reached.most;
                     }) &&
         of_far(kFarther) < kRisesOn;
}

}  // namespace bladecurve
