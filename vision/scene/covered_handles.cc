// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/covered_handles.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/image/cross.h"
#include "vision/scene/limbs.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// What may be the gap between two blades, its `axis` a unit vector towards the tips.
struct Gap {
  Vector2d crotch, axis;
  double blade_px = 0;
};

// Its deepest place, and the places between which it opens, as indices into the contour.
std::optional<Gap> GapOf(const Outline& outline, int start, int far, int end) {
  constexpr double kShortestPx = 16;
  constexpr double kAlike = 0.5;    // shorter blade over longer one
  constexpr double kWidest = -0.2;  // cosine; a blade and a shank part by more than blades do
  Gap gap;
  gap.crotch = outline.At(far);
  const Vector2d first = outline.At(start) - gap.crotch;
  const Vector2d second = outline.At(end) - gap.crotch;
  gap.blade_px = std::max(first.norm(), second.norm());
  const double shorter_px = std::min(first.norm(), second.norm());
  if (gap.blade_px < kShortestPx || shorter_px < kAlike * gap.blade_px ||
      first.dot(second) < kWidest * shorter_px * gap.blade_px)
    return std::nullopt;
  gap.axis = (first.normalized() + second.normalized()).normalized();
  return gap;
}

// The place of the outline between two others that lies furthest to one side of the straight way
// from one to the other: into the thing where there is an inlet, out of it where a limb ends.
constexpr int kInto = 1, kOutOf = -1;
int FurthestAside(const Outline& outline, int from, int to, int side) {
  const Vector2d a = outline.At(from), way = outline.At(to) - a;
  int best = from;
  double furthest = 0;
  for (int i = from; outline.Wrap(i - to) != 0; ++i) {
    const double aside = side * Cross(way, outline.At(i) - a);
    if (aside <= furthest) continue;
    furthest = aside;
    best = outline.Wrap(i);
  }
  return best;
}

// The deepest inlets; and where another thing hangs on the handles and goes on beside the blades,
// so that the gap between these is no inlet of the hull, what lies beside the limb on either side
// of an inlet.
std::vector<Gap> GapsOf(const std::vector<cv::Point>& contour) {
  constexpr std::size_t kMost = 4;
  const Outline outline(contour);
  std::vector<Gap> gaps;
  const auto add = [&](int start, int far, int end) {
    constexpr double kSamePx = 4;
    const std::optional<Gap> gap = GapOf(outline, start, far, end);
    const bool is_known = gap && std::ranges::any_of(gaps, [&](const Gap& known) {
                            return (known.crotch - gap->crotch).norm() < kSamePx;
                          });
    if (gap && !is_known) gaps.push_back(*gap);
  };
  for (const Inlet& inlet : DeepestInlets(contour, kMost)) {
    add(inlet.start, inlet.far, inlet.end);
    const int end_of_next = FurthestAside(outline, inlet.far, inlet.end, kOutOf);
    add(end_of_next, FurthestAside(outline, end_of_next, inlet.end, kInto), inlet.end);
    const int end_before = FurthestAside(outline, inlet.start, inlet.far, kOutOf);
    add(inlet.start, FurthestAside(outline, inlet.start, end_before, kInto), end_before);
  }
  return gaps;
}

// The joint behind a gap, up to where it is cut.
struct Joint {
  Vector2d end;  // the middle of the cut
  double width_px = 0;
};

// std::nullopt where the thing ends there, parts into shanks, or goes on as narrow as it is.
std::optional<Joint> JointBehind(const Silhouette& silhouette,
                                 const cv::Mat& hidden,
                                 const Gap& gap,
                                 const std::optional<Vector2d>& pivot) {
  constexpr double kBehindPivot = 0.5;  // of the width
  constexpr double kWider = 1.4;        // times the narrowest: something else begins
  constexpr double kFarthest = 2.5;     // of the blades from the gap on
  constexpr double kShortest = 0.5;     // of the width; a joint holds a screw
  constexpr double kMarginPx = 2;       // before that
  const Vector2d across(-gap.axis.y(), gap.axis.x());
  Vector2d middle = gap.crotch;
  double narrowest = gap.blade_px;
  for (int way = 1; way < kFarthest * gap.blade_px; ++way) {
    const Vector2d at = middle - gap.axis;
    const std::vector<Run> runs = RunsAcross(silhouette.filled, at, across, gap.blade_px);
    const auto run =
        std::ranges::find_if(runs, [](const Run& each) { return each.from <= 0 && each.to >= 0; });
    const bool is_past_pivot = pivot && (*pivot - at).dot(gap.axis) > kBehindPivot * narrowest;
    if (is_past_pivot) return Joint{middle, narrowest};
    if (run == runs.end()) return std::nullopt;
    const double width = run->Length();
    const std::vector<Vector2d> sides{at + run->from * across, at + run->to * across};
    if (width > kWider * narrowest || RunsOutOfSight(sides, hidden, silhouette.filled.size())) {
      if (way - kMarginPx < kShortest * narrowest) return std::nullopt;
      return Joint{middle + kMarginPx * gap.axis, narrowest};
    }
    narrowest = std::min(narrowest, width);
    middle = at + 0.5 * (run->from + run->to) * across;
  }
  return std::nullopt;
}

int NearestOf(const std::vector<cv::Point>& contour, const Vector2d& at) {
  const auto off = [&](const cv::Point& p) { return (Vector2d(p.x, p.y) - at).squaredNorm(); };
  return static_cast<int>(std::ranges::min_element(contour, {}, off) - contour.begin());
}

// Also of places out of the picture.
cv::Point PointAt(const Vector2d& at) { return {cvRound(at.x()), cvRound(at.y())}; }

std::optional<WithoutHandles> CutOff(const Silhouette& silhouette,
                                     const cv::Mat& hidden,
                                     const Gap& gap,
                                     const Joint& joint) {
  constexpr double kNotchWidth = 0.3;  // of the joint's
  constexpr double kNotchPx = 4;
  const Vector2d across(-gap.axis.y(), gap.axis.x());
  const double far = silhouette.filled.cols + silhouette.filled.rows;
  cv::Mat beyond = cv::Mat::zeros(silhouette.filled.size(), CV_8UC1);
  const std::vector<cv::Point> half_plane{PointAt(joint.end + far * across),
                                          PointAt(joint.end - far * across),
                                          PointAt(joint.end - far * (across + gap.axis)),
                                          PointAt(joint.end + far * (across - gap.axis))};
  cv::fillConvexPoly(beyond, half_plane, 255);
  const double half_width = 0.5 * kNotchWidth * joint.width_px;
  const std::vector<cv::Point> notch{PointAt(joint.end + half_width * across),
                                     PointAt(joint.end - half_width * across),
                                     PointAt(joint.end + kNotchPx * gap.axis)};
  cv::Mat left = silhouette.filled & ~beyond;
  cv::fillConvexPoly(left, notch, 0);
  constexpr int kMostThings = 3;  // what the handles lie on may reach beside the blades
  const std::vector<Silhouette> things = FindSilhouettes(left, kMostThings);
  const Silhouette* own = ThingAt(things, 0.5 * (gap.crotch + joint.end));
  if (own == nullptr) return std::nullopt;
  if (!hidden.empty()) beyond |= hidden;
  const Crotches crotches{NearestOf(own->contour, gap.crotch),
                          NearestOf(own->contour, joint.end + kNotchPx * gap.axis)};
  return WithoutHandles{*own, std::move(beyond), crotches};
}

}  // namespace

std::vector<WithoutHandles> CutOffHandles(const Silhouette& silhouette,
                                          const cv::Mat& hidden,
                                          const std::optional<Vector2d>& pivot) {
  std::vector<WithoutHandles> cut;
  for (const Gap& gap : GapsOf(silhouette.contour)) {
    const std::optional<Joint> joint = JointBehind(silhouette, hidden, gap, pivot);
    if (!joint) continue;
    if (auto without = CutOff(silhouette, hidden, gap, *joint)) cut.push_back(*std::move(without));
  }
  return cut;
}

}  // namespace bladecurve
