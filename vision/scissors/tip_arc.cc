// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/tip_arc.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Points of the followed edge that go on straight where the arc has left it already. Past the crown
// there is no blade to follow.
int Denials(const std::vector<EndSeen>& followed, const TipArc& arc) {
  constexpr double kClearly = 1;  // px
  return static_cast<int>(
      std::count_if(followed.begin(), followed.end(), [&](const EndSeen& point) {
        const double along = point.position - arc.start;
        if (along <= 0 || along >= arc.radius) return false;
        const double depth = arc.radius - std::sqrt(arc.radius * arc.radius - along * along);
        return point.depth < depth - kClearly;
      }));
}

constexpr double kOnArc = 0.7;  // px

// Where an arc of this radius on which an end lies leaves the edge. std::nullopt for ends that lie
// too near to the edge to tell, or too deep in the blade.
std::optional<double> StartOfArc(double radius, const EndSeen& end) {
  constexpr double kNearest = 0.1, kDeepest = 1.25;  // radii: beyond the crown begins another side
  if (end.depth < kNearest * radius || end.depth > kDeepest * radius) return std::nullopt;
  const double rise = radius - end.depth;
  return end.position - std::sqrt(std::max(0.0, radius * radius - rise * rise));
}

// The arc of this radius that explains most of the ends seen.
TipArc ArcOfRadius(double radius,
                   const std::vector<EndSeen>& ends,
                   const std::vector<EndSeen>& followed) {
  constexpr double kDenialPenalty = 0.5;
  std::vector<double> starts, steps;
  for (const EndSeen& end : ends) {
    const auto start = StartOfArc(radius, end);
    if (!start) continue;
    starts.push_back(*start);
    steps.push_back(end.step);
  }
  if (starts.size() < 5) return {};
  TipArc arc{Median(starts), radius, 0, 0, 0, 0};
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

EdgeAxis::EdgeAxis(const std::vector<Vector2d>& edge, const Vector2d& tip_px, bool blade_on_left)
    : origin(edge.front()), along(AlongChord(edge)) {
  constexpr double kFrom = 0.1, kTo = 0.93;  // shares of the edge's length
  const Vector2d left(along.y(), -along.x());
  inwards = blade_on_left ? left : Vector2d(-left);
  length = PositionOf(tip_px);
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const Vector2d& p : edge) {
    const double s = PositionOf(p) / length;
    if (s < kFrom || s > kTo) continue;
    const Eigen::Vector4d row(1, s, s * s, s * s * s);
    normal += row * row.transpose();
    right += row * (p - origin).dot(inwards);
  }
  normal.diagonal().array() += 1e-9;
  cubic = normal.ldlt().solve(right);
}

double EdgeAxis::PositionOf(const Vector2d& place_px) const {
  return (place_px - origin).dot(along);
}

bool TipArc::Explains(const EndSeen& end) const {
  const auto its_start = StartOfArc(radius, end);
  return its_start && std::abs(*its_start - start) < kOnArc;
}

TipArc FitTipArc(const std::vector<EndSeen>& ends,
                 const std::vector<EndSeen>& followed,
                 double largest_radius) {
  constexpr double kSmallest = 2, kRatio = 1.06;
  TipArc best;
  for (double radius = kSmallest; radius <= largest_radius; radius *= kRatio) {
    const TipArc arc = ArcOfRadius(radius, ends, followed);
    if (arc.score > best.score) best = arc;
  }
  return best;
}

}  // namespace bladecurve
