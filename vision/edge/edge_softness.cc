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
  // Off the path, px. A step blurred by 6 px has half its height at 4, and all of it at 12; one
  // blurred by 14 px at 24. Light that falls off over the whole picture rises on and on.
  constexpr double kNear = 2, kFar = 12, kFarther = 24;
  constexpr double kLeastGrey = 12;
  constexpr double kSoft = 0.35, kRisesOn = 1.7;
  const double far = TypicalStep(grey, path, kFar), near = TypicalStep(grey, path, kNear);
  return std::abs(far) > kLeastGrey && near / far < kSoft &&
         TypicalStep(grey, path, kFarther) / far < kRisesOn;
}

}  // namespace bladecurve
