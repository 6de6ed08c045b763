// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/followed_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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
      step += (depth < 0 ? 1 : -1) * BilinearWithin<uchar>(grey, p);
    }
  }
  return step / kPlaces;
}

// The steps from one position to another; all 0 out of the picture.
struct Steps {
  double typical = 0;
  double grain = 0;  // how they scatter from place to place

  // From grain, too, which beyond the blade would be taken for more of it.
  [[nodiscard]] bool StandOut() const {
    constexpr double kLeastGrey = 8;
    return std::abs(typical) > std::max(kLeastGrey, grain);
  }
};

// Standard deviation about the typical values of short stretches: where a bevel begins is no grain.
double GrainOf(const std::vector<double>& steps) {
  constexpr std::ptrdiff_t kStretch = 12;  // px
  std::vector<double> off;
  for (auto from = steps.begin(); from != steps.end();) {
    const auto to = from + std::min(kStretch, steps.end() - from);
    const double typical = Median({from, to});
    for (; from != to; ++from) off.push_back(*from - typical);
  }
  return kSigmaPerMedian * MedianAbsolute(std::move(off));
}

Steps StepsBetween(
    const cv::Mat& grey, const EdgeAxis& axis, double from, double to, double blur_px) {
  std::vector<double> steps;
  for (double t = from; t < to; ++t) {
    if (const auto step = StepAcross(grey, axis, t, blur_px)) steps.push_back(*step);
  }
  const double grain = GrainOf(steps);
  return {Median(std::move(steps)), grain};
}

// Light at a depth inside the edge, a little way along it averaged. std::nullopt out of the
// picture.
std::optional<double> LightAt(const cv::Mat& grey,
                              const EdgeAxis& axis,
                              double position,
                              double depth) {
  constexpr double kToEitherSide = 1.5, kSpacing = 0.5;  // px
  double sum = 0;
  int count = 0;
  for (double along = -kToEitherSide; along <= kToEitherSide; along += kSpacing, ++count) {
    const Vector2d p = axis.At(position + along, depth);
    if (!LiesWithin(grey, p)) return std::nullopt;
    sum += BilinearWithin<uchar>(grey, p);
  }
  return sum / count;
}

// Where, beyond the end of the step across the edge, it is looked whether the blade goes on.
struct Beyond {
  double from = 0, to = 0;  // positions; up to the presumed tip
  double off = 0;           // px off the edge continued
  double differs = 0;       // grey values that are a difference
};

// std::nullopt where the presumed tip is too near to tell.
std::optional<Beyond> LookBeyond(const EdgeAxis& axis,
                                 double position,
                                 double step,
                                 const TipSearch& search) {
  constexpr double kOff = 3;                 // standard deviations of the blur, off the edge
  constexpr double kShare = 0.4;             // of the step is a difference
  constexpr double kClear = 3, kFewest = 8;  // px; the tip's arc and its blur
  const double to = axis.PositionOf(search.tip_px);
  if (to - position < kClear + std::max(kFewest, search.reach_px)) return std::nullopt;
  const double off = kOff * std::sqrt(TotalBlurVariance(search.blur_px));
  return Beyond{position + kClear, to, off, kShare * std::abs(step)};
}

// Whether a bright blade ends before the presumed tip: inside the edge continued, next to nothing
// is as bright as the blade before, or brighter than the ground outside, as a blade is behind a
// bevel that mirrors the ground.
bool BrightBladeEnds(const cv::Mat& grey,
                     const EdgeAxis& axis,
                     const Beyond& beyond,
                     double blade_width_px) {
  constexpr double kNearest = 6, kFurthest = 23;  // px before
  constexpr double kDeepest = 0.5, kMost = 0.1;   // of the blade's width; of the places beyond
  std::vector<double> before;
  for (double t = beyond.from - kFurthest; t < beyond.from - kNearest; ++t) {
    if (const auto light = LightAt(grey, axis, t, beyond.off)) before.push_back(*light);
  }
  if (before.empty()) return false;
  const double blade = Median(before);
  const auto is_blade = [&](double t) {
    const auto outside = LightAt(grey, axis, t, -beyond.off);
    if (!outside) return true;
    for (double depth = beyond.off; depth < kDeepest * blade_width_px; ++depth) {
      const auto inside = LightAt(grey, axis, t, depth);
      if (!inside || *inside > *outside + beyond.differs ||
          std::abs(*inside - blade) < beyond.differs)
        return true;
    }
    return false;
  };
  double places = 0, of_blade = 0;
  for (double t = beyond.from; t < beyond.to; ++t, ++places) of_blade += is_blade(t);
  return of_blade < kMost * places;
}

// Whether a dark blade ends before the presumed tip, which is that of its shadow: what is dark
// inside the edge continued keeps off it, where a blade behind a bevel that mirrors the ground
// would taper off to meet it.
bool DarkBladeEnds(const cv::Mat& grey,
                   const EdgeAxis& axis,
                   const Beyond& beyond,
                   double blade_width_px) {
  constexpr double kLeastGap = 0.1;  // of the blade's width
  constexpr double kKeepsOff = 0.9;  // of the gap, further on
  const auto gap_at = [&](double t) {
    const auto outside = LightAt(grey, axis, t, -beyond.off);
    for (double depth = beyond.off; outside && depth < blade_width_px; ++depth) {
      const auto inside = LightAt(grey, axis, t, depth);
      if (inside && *inside < *outside - beyond.differs) return depth;
    }
    return blade_width_px;
  };
  std::vector<double> near, far;
  const double middle = 0.5 * (beyond.from + beyond.to);
  for (double t = beyond.from; t < beyond.to; ++t) (t < middle ? near : far).push_back(gap_at(t));
  const double gap = Median(near);
  return gap > kLeastGap * blade_width_px && Median(far) > kKeepsOff * gap;
}

// Follows a step like the usual one from one position on, at most to another.
FollowedStep Follow(const cv::Mat& grey,
                    const EdgeAxis& axis,
                    double from,
                    double to,
                    double usual,
                    const TipSearch& search) {
  constexpr double kShare = 0.4;  // of the step there is still a step
  constexpr double kLost = 8;     // px without one
  double seen = from;
  for (double t = from; t < to; ++t) {
    const auto step = StepAcross(grey, axis, t, search.blur_px);
    if (!step) return {usual, std::nullopt};
    if (*step / usual > kShare) seen = t;
    if (t - seen > kLost) {
      const auto blade_ends = usual < 0 ? BrightBladeEnds : DarkBladeEnds;
      const std::optional<Beyond> beyond = LookBeyond(axis, seen, usual, search);
      const bool ends = beyond && blade_ends(grey, axis, *beyond, search.blade_width_px);
      return {usual, axis.At(seen, 0), ends};
    }
  }
  return {usual, std::nullopt};
}

}  // namespace

FollowedStep FollowStep(const cv::Mat& grey,
                        const std::vector<Vector2d>& edge,
                        const TipSearch& search) {
  constexpr double kMiddle = 0.5, kLastPart = 0.8, kFurthest = 1.5;  // of the edge's length
  if (edge.size() < kFewestEdgePoints) return {};
  const EdgeAxis axis(edge, search.tip_px, search.blade_on_left);
  const double last = axis.PositionOf(edge.back());
  const double middle = kMiddle * last, last_part = kLastPart * last, furthest = kFurthest * last;
  const Steps late = StepsBetween(grey, axis, last_part, last, search.blur_px);
  if (late.typical > 0) {
    const Steps early = StepsBetween(grey, axis, middle, last_part, search.blur_px);
    if (early.typical < 0 && early.StandOut()) {
      const FollowedStep turned = Follow(grey, axis, middle, furthest, early.typical, search);
      if (turned.blade_ends) return turned;
    }
  }
  if (!late.StandOut()) return {};
  return Follow(grey, axis, last_part, furthest, late.typical, search);
}

}  // namespace bladecurve
