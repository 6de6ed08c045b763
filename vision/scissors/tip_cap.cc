// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/tip_cap.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "vision/image/bilinear.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kFewestPoints = 12;  // fewer say nothing about where the edge goes on

// The cutting edge, continued over the tip: positions along its chord, offsets into the blade.
struct EdgeAxis {
  Vector2d origin, along, inwards;
  Eigen::Vector4d cubic;  // offset of the edge over the share of its length
  double length = 0;

  [[nodiscard]] double EdgeOffset(double t) const {
    const double s = t / length;
    return cubic[0] + s * (cubic[1] + s * (cubic[2] + s * cubic[3]));
  }
  // The point at position t, `depth` px inside the blade.
  [[nodiscard]] Vector2d At(double t, double depth) const {
    return origin + t * along + (EdgeOffset(t) + depth) * inwards;
  }
};

// A cubic through the part of the edge that is clear of the crotch and of the tip.
EdgeAxis ContinueEdge(const std::vector<Vector2d>& edge, const TipSearch& search) {
  constexpr double kFrom = 0.1, kTo = 0.93;  // shares of the edge's length
  EdgeAxis axis;
  axis.origin = edge.front();
  axis.along = AlongChord(edge);
  const Vector2d left(axis.along.y(), -axis.along.x());
  axis.inwards = search.blade_on_left ? left : Vector2d(-left);
  axis.length = (search.tip_px - axis.origin).dot(axis.along);
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const Vector2d& p : edge) {
    const double s = (p - axis.origin).dot(axis.along) / axis.length;
    if (s < kFrom || s > kTo) continue;
    const Eigen::Vector4d row(1, s, s * s, s * s * s);
    normal += row * row.transpose();
    right += row * (p - axis.origin).dot(axis.inwards);
  }
  normal.diagonal().array() += 1e-9;
  axis.cubic = normal.ldlt().solve(right);
  return axis;
}

struct EndSeen {
  double depth = 0, position = 0;
  double step = 0;  // grey values
};

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
      if (p.x() < 1 || p.y() < 1 || p.x() > grey.cols - 2 || p.y() > grey.rows - 2)
        return std::nullopt;
      step += (depth < 0 ? 1 : -1) * Bilinear<uchar>(grey, p);
    }
  }
  return step / kPlaces;
}

// The strongest step along one line, if it stands out from the others on it.
std::optional<EndSeen> LookAlong(
    const cv::Mat& grey, const EdgeAxis& axis, double depth, double from, double to) {
  constexpr double kStep = 0.5;
  constexpr int kHalf = 3;          // samples on either side that are averaged
  constexpr double kLeastGrey = 6;  // steps below that are noise
  std::vector<double> values;
  for (double t = from - kHalf * kStep; t <= to + kHalf * kStep; t += kStep) {
    const Vector2d p = axis.At(t, depth);
    if (p.x() < 1 || p.y() < 1 || p.x() > grey.cols - 2 || p.y() > grey.rows - 2)
      return std::nullopt;
    values.push_back(Bilinear<uchar>(grey, p));
  }
  double best = 0, sign = 1;
  std::size_t best_at = 0;
  std::vector<double> steps(values.size(), 0.0);
  for (std::size_t i = kHalf; i + kHalf < values.size(); ++i) {
    double step = 0;
    for (int k = 1; k <= kHalf; ++k) {
      step += values[i + static_cast<std::size_t>(k)] - values[i - static_cast<std::size_t>(k)];
    }
    steps[i] = std::abs(step) / kHalf;
    if (steps[i] > best) {
      best = steps[i];
      best_at = i;
      sign = step < 0 ? -1 : 1;
    }
  }
  if (best < kLeastGrey) return std::nullopt;
  // Sub-sample by the parabola through the peak.
  double shift = 0;
  if (best_at > 0 && best_at + 1 < steps.size()) {
    const double curvature = steps[best_at - 1] - 2 * best + steps[best_at + 1];
    if (curvature < 0)
      shift = std::clamp(0.5 * (steps[best_at - 1] - steps[best_at + 1]) / curvature, -0.5, 0.5);
  }
  return EndSeen{
      depth, from - kHalf * kStep + kStep * (static_cast<double>(best_at) + shift), sign * best};
}

struct Arc {
  double start = 0, radius = 0;
  double score = 0;  // lines explained less lines contradicted, less what the edge denies
  double scatter = 0;
  int seen = 0;
  double step = 0;  // typical
};

// Points of the followed edge that go on straight where the arc has left it already. Past the crown
// there is no blade to follow.
int Denials(const std::vector<EndSeen>& followed, const Arc& arc) {
  constexpr double kClearly = 1;  // px
  return static_cast<int>(
      std::count_if(followed.begin(), followed.end(), [&](const EndSeen& point) {
        const double along = point.position - arc.start;
        if (along <= 0 || along >= arc.radius) return false;
        const double depth = arc.radius - std::sqrt(arc.radius * arc.radius - along * along);
        return point.depth < depth - kClearly;
      }));
}

// The arc of this radius that explains most of the ends seen.
Arc BestArc(const std::vector<EndSeen>& ends, const std::vector<EndSeen>& followed, double radius) {
  constexpr double kOnArc = 0.7;     // px
  constexpr double kDeepest = 1.25;  // radii: beyond the crown another side of the tip begins
  constexpr double kDenialPenalty = 0.5;
  std::vector<double> starts, steps;
  for (const EndSeen& end : ends) {
    if (end.depth < 0.1 * radius || end.depth > kDeepest * radius) continue;
    const double rise = radius - end.depth;
    starts.push_back(end.position - std::sqrt(std::max(0.0, radius * radius - rise * rise)));
    steps.push_back(end.step);
  }
  if (starts.size() < 5) return {};
  Arc arc{Median(starts), radius, 0, 0, 0, 0};
  std::vector<double> off, steps_on_arc;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (std::abs(starts[i] - arc.start) >= kOnArc) continue;
    off.push_back(std::abs(starts[i] - arc.start));
    steps_on_arc.push_back(steps[i]);
  }
  if (off.size() < 5) return {};
  arc.seen = static_cast<int>(off.size());
  arc.scatter = kSigmaPerMedian * Median(off);
  arc.step = Median(steps_on_arc);
  arc.score = 2.0 * arc.seen - static_cast<double>(starts.size()) - arc.scatter -
              kDenialPenalty * Denials(followed, arc);
  return arc;
}

}  // namespace

Vector2d AlongChord(const std::vector<Vector2d>& edge) {
  return (edge[edge.size() * 4 / 5] - edge.front()).normalized();
}

std::optional<TipCap> FitTipCap(const cv::Mat& grey,
                                const std::vector<Vector2d>& edge,
                                const TipSearch& search) {
  if (edge.size() < kFewestPoints) return std::nullopt;
  const EdgeAxis axis = ContinueEdge(edge, search);
  const double tip = (search.tip_px - axis.origin).dot(axis.along);
  const double deepest = std::max(6.0, 0.45 * search.blade_width_px);
  std::vector<EndSeen> ends;
  for (double depth = 1; depth <= deepest; depth += std::max(0.5, deepest / 40)) {
    const auto end = LookAlong(grey, axis, depth, tip - search.reach_px, tip + search.reach_px);
    if (end) ends.push_back(*end);
  }
  if (ends.size() < 6) return std::nullopt;
  std::vector<EndSeen> followed;
  for (const Vector2d& p : edge) {
    const double position = (p - axis.origin).dot(axis.along);
    followed.push_back({(p - axis.At(position, 0)).dot(axis.inwards), position, 0});
  }
  Arc best;
  for (double radius = 2; radius <= deepest; radius *= 1.06) {
    const Arc arc = BestArc(ends, followed, radius);
    if (arc.score > best.score) best = arc;
  }
  if (best.seen == 0) return std::nullopt;
  return TipCap{axis.At(best.start, 0), best.radius, best.scatter, best.seen, best.step};
}

FollowedStep FollowStep(const cv::Mat& grey,
                        const std::vector<Vector2d>& edge,
                        const TipSearch& search) {
  constexpr double kLastPart = 0.2;  // of the edge's length
  constexpr double kShare = 0.4;     // of the step there is still a step
  constexpr double kLost = 8;        // px without one
  constexpr double kLeastGrey = 8;
  constexpr double kFurthest = 1.5;  // edge's lengths
  if (edge.size() < kFewestPoints) return {};
  const EdgeAxis axis = ContinueEdge(edge, search);
  const double last = (edge.back() - axis.origin).dot(axis.along);
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

TipCap UsualTipCap(const std::vector<Vector2d>& edge, const TipSearch& search) {
  constexpr double kUsualRadius = 0.1;  // of the width: Mayo 0.12, Metzenbaum 0.12, iris 0.06
  const EdgeAxis axis = ContinueEdge(edge, search);
  const double tip = (search.tip_px - axis.origin).dot(axis.along);
  const double radius = kUsualRadius * search.blade_width_px;
  return TipCap{axis.At(tip - radius, 0), radius, 0, 0, 0};
}

}  // namespace bladecurve
