// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/followed_step.h"

#include <cmath>

#include "vision/image/bilinear.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/scissors/tip_arc.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Light outside the edge less light inside, a little way off it. std::nullopt out of the picture.
std::optional<double> StepAcross(const cv::Mat& grey,
                                 const EdgeAxis& axis,
                                 double position,
                                 double blur_px) {
  constexpr double kNear = 1.5, kFar = 4.5;  // standard deviations of the blur, off the edge
  constexpr int kPlaces = 7;
  const double deviation_px = std::sqrt(TotalBlurVariance(blur_px));
  double step = 0;
  for (int place = 0; place < kPlaces; ++place) {
    const double off = deviation_px * (kNear + (kFar - kNear) * place / (kPlaces - 1));
    for (const double depth : {-off, off}) {
      const Vector2d p = axis.At(position, depth);
      if (!LiesWithin(grey, p)) return std::nullopt;
      step += (depth < 0 ? 1 : -1) * Bilinear<uchar>(grey, p);
    }
  }
  return step / kPlaces;
}

}  // namespace

FollowedStep FollowStep(const cv::Mat& grey,
                        const std::vector<Vector2d>& edge,
                        const TipSearch& search) {
  constexpr double kLastPart = 0.2;  // of the edge's length
  constexpr double kShare = 0.4;     // of the step there is still a step
  constexpr double kLost = 8;        // px without one
  constexpr double kLeastGrey = 8;
  constexpr double kFurthest = 1.5;  // edge's lengths
  if (edge.size() < kFewestEdgePoints) return {};
  const EdgeAxis axis(edge, search.tip_px, search.blade_on_left);
  const double last = axis.PositionOf(edge.back());
  std::vector<double> steps;
  for (double t = (1 - kLastPart) * last; t < last; ++t) {
    if (const auto step = StepAcross(grey, axis, t, search.blur_px)) steps.push_back(*step);
  }
  const double usual = Median(steps);
  if (!(std::abs(usual) > kLeastGrey)) return {};
  double seen = (1 - kLastPart) * last;
  for (double t = seen; t < kFurthest * last; ++t) {
    const auto step = StepAcross(grey, axis, t, search.blur_px);
    if (!step) return {usual, std::nullopt};
    if (*step / usual > kShare) seen = t;
    if (t - seen > kLost) return {usual, axis.At(seen, 0)};
  }
  return {usual, std::nullopt};
}

}  // namespace bladecurve
