// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/limbs.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/image/cross.h"
#include "vision/image/nearest_pixel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kRunStep = 0.5;  // px

// Without its first part, where a shadow or the coarseness of the mask may fill the crotch.
std::vector<Vector2d> ClearOfCrotch(const std::vector<Vector2d>& inner) {
  constexpr double kFilledShare = 0.15;
  const double reach = kFilledShare * (inner.back() - inner.front()).norm();
  const auto clear = std::find_if(inner.begin(), inner.end(), [&](const Vector2d& p) {
    return (p - inner.front()).norm() > reach;
  });
  return {clear, inner.end()};
}

// Sag and roughness of a polyline about the parabola through it, relative to its chord.
void DescribeSide(const std::vector<Vector2d>& side, BladeContour* blade) {
  const Vector2d origin = side.front();
  const Vector2d chord = side.back() - origin;
  const double length = chord.norm();
  if (length < 4 || side.size() < 6) {
    blade->roughness = 1;
    return;
  }
  const Vector2d along = chord / length;
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(side.size()), 3);
  Eigen::VectorXd offsets(static_cast<Eigen::Index>(side.size()));
  for (std::size_t i = 0; i < side.size(); ++i) {
    const Vector2d p = side[i] - origin;
    const double t = p.dot(along) / length;
    terms.row(static_cast<Eigen::Index>(i)) << 1, t, t * t;
    offsets[static_cast<Eigen::Index>(i)] = Cross(along, p) / length;
  }
  const Eigen::Vector3d k = (terms.transpose() * terms).ldlt().solve(terms.transpose() * offsets);
  blade->bend = std::abs(k[2]) / 4;
  blade->roughness =
      std::sqrt((offsets - terms * k).squaredNorm() / static_cast<double>(side.size()));
}

// Of a shank half way along, beside whatever lies on it there: a label.
double WidthHalfWay(const cv::Mat& filled, const Vector2d& from, const Vector2d& to) {
  constexpr double kUncovered = 1.8;  // times the width elsewhere; shanks taper less
  const double width = WidthAcross(filled, from, to, 0.4);
  std::array<double, 4> elsewhere{0.3, 0.5, 0.56, 0.62};
  for (double& t : elsewhere) t = WidthAcross(filled, from, to, t);
  std::sort(elsewhere.begin(), elsewhere.end());
  return width > kUncovered * elsewhere[1] ? elsewhere[1] : width;
}

}  // namespace

bool RunsOutOfSight(const std::vector<Vector2d>& points,
                    const cv::Mat& hidden,
                    const cv::Size& size) {
  const cv::Rect inner(2, 2, size.width - 4, size.height - 4);
  return std::any_of(points.begin(), points.end(), [&](const Vector2d& p) {
    return !inner.contains(NearestPixel(p)) || (!hidden.empty() && IsSetNear(hidden, p));
  });
}

std::vector<Inlet> FindInlets(const std::vector<cv::Point>& contour) {
  // Shallower ones are ragged borders and the waists of rings.
  constexpr double kShallowestShare = 0.03;
  std::vector<Inlet> inlets;
  if (contour.size() < 30) return inlets;
  std::vector<int> hull;
  cv::convexHull(contour, hull, false, false);
  std::sort(hull.begin(), hull.end());
  const cv::Rect box = cv::boundingRect(contour);
  const double shallowest = std::max(3.0, kShallowestShare * std::max(box.width, box.height));
  const Outline outline(contour);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    Inlet inlet;
    inlet.start = hull[k];
    inlet.end = hull[(k + 1) % hull.size()];
    const Vector2d a = outline.At(inlet.start);
    const Vector2d chord = outline.At(inlet.end) - a;
    const double length = chord.norm();
    if (length < 2) continue;
    const int steps = outline.Wrap(inlet.end - inlet.start);
    for (int i = 1; i < steps; ++i) {
      const double depth = std::abs(Cross(chord, outline.At(inlet.start + i) - a)) / length;
      if (depth > inlet.depth) {
        inlet.depth = depth;
        inlet.far = outline.Wrap(inlet.start + i);
      }
    }
    if (inlet.depth >= shallowest) inlets.push_back(inlet);
  }
  return inlets;
}

std::vector<Inlet> DeepestInlets(const std::vector<cv::Point>& contour, std::size_t most) {
  std::vector<Inlet> inlets = FindInlets(contour);
  if (inlets.size() <= most) return inlets;
  std::sort(inlets.begin(), inlets.end(), [](const Inlet& a, const Inlet& b) {
    return a.depth > b.depth;
  });
  inlets.resize(most);
  std::sort(inlets.begin(), inlets.end(), [](const Inlet& a, const Inlet& b) {
    return a.start < b.start;
  });
  return inlets;
}

int LimbEnd(const Outline& outline, int from, int to, Way way, const Vector2d& direction) {
  constexpr double kLimb = 0.5;  // of the furthest; ragged outlines go to and fro by less
  constexpr int kStride = 4;
  const Vector2d crotch = outline.At(from), other_crotch = outline.At(to);
  const int sign = way == Way::kOn ? 1 : -1, steps = outline.Wrap(sign * (to - from));
  double furthest_px2 = 0;  // to a few px
  for (int k = 0; k <= steps; k += kStride) {
    const Vector2d offset = outline.At(from + sign * k) - crotch;
    if (offset.dot(direction) > 0) furthest_px2 = std::max(furthest_px2, offset.squaredNorm());
  }
  int best = -1;
  double reach_px2 = 0;
  for (int k = 0; k <= steps; ++k) {
    const Vector2d at = outline.At(from + sign * k), offset = at - crotch;
    const bool past_half = reach_px2 >= kLimb * kLimb * furthest_px2;
    if (past_half && (at - other_crotch).dot(direction) <= 0) break;
    if (offset.dot(direction) <= 0 || offset.squaredNorm() <= reach_px2) continue;
    reach_px2 = offset.squaredNorm();
    best = outline.Wrap(from + sign * k);
  }
  return best;
}

std::vector<Run> RunsAcross(const cv::Mat& filled,
                            const Vector2d& center,
                            const Vector2d& across,
                            double reach) {
  std::vector<Run> runs;
  bool inside = false;
  for (double d = -reach; d <= reach; d += kRunStep) {
    const bool set = IsSetAt(filled, center + d * across);
    if (set && !inside) runs.push_back({d, d});
    if (set) runs.back().to = d;
    inside = set;
  }
  return runs;
}

double WidthAcross(const cv::Mat& filled, const Vector2d& from, const Vector2d& to, double t) {
  constexpr double kBent = 0.15;  // of the length: how far a limb's side leaves the line
  const Vector2d along = (to - from).normalized();
  const Vector2d across(-along.y(), along.x());
  const double length = (to - from).norm();
  double longest = 0;
  for (const Run& run : RunsAcross(filled, from + t * (to - from), across, kLimbReach * length)) {
    if (std::max(run.from, -run.to) > kBent * length) continue;  // another limb
    longest = std::max(longest, run.Length() + kRunStep);
  }
  return longest;
}

BladeContour DescribeBlade(const Silhouette& silhouette,
                           std::vector<Vector2d> inner,
                           std::vector<Vector2d> outer) {
  BladeContour blade;
  blade.tip = inner.back();
  const Vector2d crotch = inner.front();
  blade.length = (blade.tip - crotch).norm();
  DescribeSide(ClearOfCrotch(inner), &blade);
  blade.width = WidthAcross(silhouette.filled, crotch, blade.tip, 0.5);
  const double near_tip = std::max(WidthAcross(silhouette.filled, crotch, blade.tip, 0.88),
                                   WidthAcross(silhouette.filled, crotch, blade.tip, 0.95));
  blade.taper = near_tip / std::max(blade.width, 1.0);
  std::vector<Vector2d> end;
  const auto near = [&](const Vector2d& p) { return (p - blade.tip).norm() < 0.15 * blade.length; };
  std::copy_if(inner.begin(), inner.end(), std::back_inserter(end), near);
  std::copy_if(outer.begin(), outer.end(), std::back_inserter(end), near);
  blade.cut_off = RunsOutOfSight(end, {}, silhouette.filled.size());
  blade.inner = std::move(inner);
  blade.outer = std::move(outer);
  return blade;
}

ShankEnd DescribeShank(const Silhouette& silhouette,
                       const cv::Mat& hidden,
                       const std::vector<Vector2d>& arc,
                       const Vector2d& point,
                       const Vector2d& shank_crotch) {
  ShankEnd end;
  end.length = (point - shank_crotch).norm();
  double widest = 0;
  for (const double t : {0.75, 0.83, 0.9, 0.95}) {
    widest = std::max(widest, WidthAcross(silhouette.filled, shank_crotch, point, t));
  }
  // Behind short shanks, those of household scissors, a ring begins before half way.
  double neck = WidthHalfWay(silhouette.filled, shank_crotch, point);
  for (const double t : {0.2, 0.3}) {
    const double width = WidthAcross(silhouette.filled, shank_crotch, point, t);
    if (width > 0) neck = std::min(neck, width);
  }
  end.flare = widest / std::max(1.0, neck);
  // The arc begins at the tip of a blade, which may be out of sight itself.
  std::vector<Vector2d> own;
  std::copy_if(arc.begin(), arc.end(), std::back_inserter(own), [&](const Vector2d& p) {
    return (p - shank_crotch).dot(point - shank_crotch) > 0;
  });
  end.cut_off = RunsOutOfSight(own, hidden, silhouette.filled.size());
  return end;
}

}  // namespace bladecurve
