// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/tip_cap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vision/image/bilinear.h"
#include "vision/image/robust_statistics.h"
#include "vision/scissors/tip_arc.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kSpacing = 0.5;  // px between samples along a line
constexpr double kLeastGrey = 6;  // steps below that are noise
constexpr std::size_t kHalf = 3;  // samples on either side of a step that are averaged

// Light along one line parallel to the edge, from a position on.
struct Line {
  double from = 0;
  std::vector<double> light;

  [[nodiscard]] double PositionAt(double index) const { return from + kSpacing * index; }
  // How much light rises about a sample; `kHalf` samples from the ends at least.
  [[nodiscard]] double StepAt(std::size_t i) const {
    double step = 0;
    for (std::size_t k = 1; k <= kHalf; ++k) step += light[i + k] - light[i - k];
    return step / kHalf;
  }
};

// std::nullopt where it leaves the picture.
std::optional<Line> LineAt(
    const cv::Mat& grey, const EdgeAxis& axis, double depth, double from, double to) {
  Line line{from, {}};
  line.light.reserve(static_cast<std::size_t>((to - from) / kSpacing) + 2);
  for (double t = from; t <= to; t += kSpacing) {
    const Vector2d p = axis.At(t, depth);
    if (!LiesWithin(grey, p)) return std::nullopt;
    line.light.push_back(BilinearWithin<uchar>(grey, p));
  }
  return line;
}

// Where light falls again beyond a sample, if it rises into a bright rim there; else that sample. A
// blade ends at the rim's outer side.
std::size_t PastRim(const std::vector<double>& steps, std::size_t at, double widest_px) {
  constexpr double kBack = 0.5;  // of the rise
  if (steps[at] <= 0) return at;
  const auto begin = steps.begin() + static_cast<std::ptrdiff_t>(at);
  const auto widest = static_cast<std::ptrdiff_t>(widest_px / kSpacing);
  const auto lowest = std::min_element(begin, begin + std::min(widest + 1, steps.end() - begin));
  return -*lowest > kBack * *begin ? static_cast<std::size_t>(lowest - steps.begin()) : at;
}

// The strongest step along one line, if it stands out from the others on it, or the outer side of
// the rim that begins there.
std::optional<EndSeen> LookAlong(
    const cv::Mat& grey, const EdgeAxis& axis, double depth, double from, double to) {
  constexpr double kMargin = kHalf * kSpacing;
  constexpr double kWidestRim = 0.2;  // of what is looked at
  const std::optional<Line> line = LineAt(grey, axis, depth, from - kMargin, to + kMargin);
  if (!line) return std::nullopt;
  std::vector<double> steps(line->light.size(), 0.0);
  for (std::size_t i = kHalf; i + kHalf < steps.size(); ++i) steps[i] = line->StepAt(i);
  const auto weaker = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto strongest_at = static_cast<std::size_t>(
      std::max_element(steps.begin(), steps.end(), weaker) - steps.begin());
  if (std::abs(steps[strongest_at]) < kLeastGrey) return std::nullopt;
  const std::size_t best_at = PastRim(steps, strongest_at, kWidestRim * (to - from));
  const double best = std::abs(steps[best_at]);
  // Sub-sample by the parabola through the peak.
  double shift = 0;
  if (best_at > 0 && best_at + 1 < steps.size()) {
    const double before = std::abs(steps[best_at - 1]), after = std::abs(steps[best_at + 1]);
    const double curvature = before - 2 * best + after;
    if (curvature < 0) shift = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  }
  return EndSeen{depth, line->PositionAt(static_cast<double>(best_at) + shift), steps[best_at]};
}

std::vector<EndSeen> EndsSeen(const cv::Mat& grey,
                              const EdgeAxis& axis,
                              double deepest,
                              const TipSearch& search) {
  const double tip = axis.PositionOf(search.tip_px);
  std::vector<EndSeen> ends;
  for (double depth = 1; depth <= deepest; depth += std::max(0.5, deepest / 40)) {
    const auto end = LookAlong(grey, axis, depth, tip - search.reach_px, tip + search.reach_px);
    if (end) ends.push_back(*end);
  }
  return ends;
}

// How sharp the step at a sample is: what is left of it close by. About 0.8 in focus; more at a
// line, where light steps back. `kFar` samples from the ends at least.
constexpr std::size_t kNear = 2, kFoot = 6, kFar = 10;
double Sharpness(const Line& line, std::size_t i) {
  const auto mean = [&](std::size_t first, std::size_t last) {
    const auto begin = line.light.begin();
    return std::accumulate(begin + static_cast<std::ptrdiff_t>(first),
                           begin + static_cast<std::ptrdiff_t>(last + 1),
                           0.0) /
           static_cast<double>(last + 1 - first);
  };
  const double whole = mean(i + kFoot, i + kFar) - mean(i - kFar, i - kFoot);
  return std::abs(line.light[i + kNear] - line.light[i - kNear]) / std::max(1.0, std::abs(whole));
}

// Of the ends that an arc explains, typically; 1 where that cannot be seen.
double SharpnessOn(const cv::Mat& grey,
                   const EdgeAxis& axis,
                   const std::vector<EndSeen>& ends,
                   const TipArc& arc) {
  constexpr double kReachPx = kSpacing * (kFar + 1);
  std::vector<double> sharpness;
  for (const EndSeen& end : ends) {
    if (!arc.Explains(end)) continue;
    const double from = end.position - kReachPx, to = end.position + kReachPx;
    if (const auto line = LineAt(grey, axis, end.depth, from, to))
      sharpness.push_back(Sharpness(*line, kFar + 1));
  }
  return sharpness.empty() ? 1 : Median(std::move(sharpness));
}

// The deepest step the other way before one end, up to `reach_px` before it, where a dark strip may
// begin that ends there; and how sharp both are.
struct StripSeen {
  EndSeen begin;
  double begin_sharpness = 0, end_sharpness = 0;
};

std::optional<StripSeen> StripBefore(const cv::Mat& grey,
                                     const EdgeAxis& axis,
                                     const EndSeen& end,
                                     double reach_px) {
  constexpr double kLeastOfEnd = 0.25;
  const double beyond_px = kSpacing * (kFar + 1);
  const auto line =
      LineAt(grey, axis, end.depth, end.position - reach_px, end.position + beyond_px);
  if (!line) return std::nullopt;
  const auto end_at = static_cast<std::size_t>(reach_px / kSpacing);
  double deepest = 0;
  std::size_t begin_at = 0;
  for (std::size_t i = kFar; i + kFar < end_at; ++i) {
    const double step = line->StepAt(i);
    if (step * end.step < 0 && std::abs(step) > std::abs(deepest)) {
      deepest = step;
      begin_at = i;
    }
  }
  if (std::abs(deepest) < std::max(kLeastGrey, kLeastOfEnd * std::abs(end.step)))
    return std::nullopt;
  return StripSeen{{end.depth, line->PositionAt(static_cast<double>(begin_at)), deepest},
                   Sharpness(*line, begin_at),
                   Sharpness(*line, end_at)};
}

// The blade's own arc, if what was seen to end is its shadow: the dark strip between the two begins
// as sharply as edges do, and ends more softly.
std::optional<TipArc> ArcBeforeShadow(const cv::Mat& grey,
                                      const EdgeAxis& axis,
                                      const std::vector<EndSeen>& ends,
                                      const std::vector<EndSeen>& followed,
                                      double deepest,
                                      double blade_px) {
  constexpr double kSharper = 1.4, kNoLine = 1.2;
  constexpr int kMany = 14;       // lines; grain and bevels give up to 12 by chance
  constexpr double kClear = 0.4;  // px of scatter
  std::vector<EndSeen> begins;
  std::vector<double> begin_sharpness, end_sharpness;
  for (const EndSeen& end : ends) {
    if (end.step < 0) continue;  // it gets no brighter there
    const auto strip = StripBefore(grey, axis, end, blade_px);
    if (!strip) continue;
    begins.push_back(strip->begin);
    begin_sharpness.push_back(strip->begin_sharpness);
    end_sharpness.push_back(strip->end_sharpness);
  }
  if (begins.size() < kMany) return std::nullopt;
  const double sharpness = Median(std::move(begin_sharpness));
  if (sharpness > kNoLine || sharpness < kSharper * Median(std::move(end_sharpness)))
    return std::nullopt;
  const TipArc arc = FitTipArc(begins, followed, deepest);
  return arc.seen >= kMany && arc.scatter < kClear ? std::optional(arc) : std::nullopt;
}

}  // namespace

std::optional<TipCap> FitTipCap(const cv::Mat& grey,
                                const std::vector<Vector2d>& edge,
                                const TipSearch& search) {
  constexpr std::size_t kFewestEnds = 6;
  if (edge.size() < kFewestEdgePoints) return std::nullopt;
  const EdgeAxis axis(edge, search.tip_px, search.blade_on_left);
  const double deepest = std::max(6.0, 0.45 * search.blade_width_px);
  const std::vector<EndSeen> ends = EndsSeen(grey, axis, deepest, search);
  if (ends.size() < kFewestEnds) return std::nullopt;
  std::vector<EndSeen> followed;
  for (const Vector2d& p : edge) {
    const double position = axis.PositionOf(p);
    followed.push_back({(p - axis.At(position, 0)).dot(axis.inwards), position, 0});
  }
  const TipArc seen = FitTipArc(ends, followed, deepest);
  if (seen.seen == 0) return std::nullopt;
  const auto own = ArcBeforeShadow(grey, axis, ends, followed, deepest, search.blade_width_px);
  const TipArc& arc = own ? *own : seen;
  return TipCap{axis.At(arc.start, 0),
                arc.radius,
                arc.scatter,
                arc.seen,
                arc.step,
                own.has_value(),
                own ? 1 : SharpnessOn(grey, axis, ends, seen)};
}

TipCap UsualTipCap(const std::vector<Vector2d>& edge, const TipSearch& search) {
  constexpr double kUsualRadius = 0.1;  // of the width: Mayo 0.12, Metzenbaum 0.12, iris 0.06
  const EdgeAxis axis(edge, search.tip_px, search.blade_on_left);
  const double radius = kUsualRadius * search.blade_width_px;
  return TipCap{axis.At(axis.PositionOf(search.tip_px) - radius, 0), radius, 0, 0, 0, false};
}

}  // namespace bladecurve
