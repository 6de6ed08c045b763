// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/occluding_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "vision/image/cross.h"
#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using StraightLine = Eigen::Hyperplane<double, 2>;

constexpr double kClearPx = 1.3;  // of a line, beyond its blur
constexpr double kReachPx = 6;    // from a line

// An edge as it runs near the crotch, where it hardly bends, and before; distances from it are
// positive outwards. Of the very first points neighbours are missing.
StraightLine LineNearCrotch(const std::vector<LocatedEdgePoint>& edge) {
  constexpr double kFrom = 0.03, kTo = 0.18;  // of the edge
  const auto at = [&](double share) {
    return edge[static_cast<std::size_t>(share * static_cast<double>(edge.size()))];
  };
  const LocatedEdgePoint from = at(kFrom), to = at(kTo);
  StraightLine line = StraightLine::Through(from.trend_px, to.trend_px);
  if (line.normal().dot(from.normal + to.normal) < 0) line.coeffs() = -line.coeffs();
  return line;
}

// Those of an edge that count, moved outwards.
std::vector<LocatedEdgePoint> InlyingPoints(const LocatedEdge& edge, double outwards_px) {
  std::vector<LocatedEdgePoint> points;
  for (LocatedEdgePoint p : edge.points) {
    if (!p.inlier) continue;
    p.trend_px += outwards_px * p.normal;
    points.push_back(p);
  }
  return points;
}

bool IsBeside(double off_px) { return std::abs(off_px) > kClearPx && std::abs(off_px) < kReachPx; }

// ln of the light along a stretch of the other blade's edge: on that blade, and beside it.
struct Sides {
  std::vector<double> blade, beside;

  [[nodiscard]] bool AreSeen() const {
    constexpr std::size_t kLeast = 6;  // pixels
    return std::min(blade.size(), beside.size()) >= kLeast;
  }
  [[nodiscard]] double Step() const { return Median(beside) - Median(blade); }
};

// About a junction of a border with that edge: beyond the border, in the band between it and the
// inner line, and within that.
struct Junction {
  Sides beyond, band, within;
};

// Of the place at these distances from border and inner line; nullptr near a line, or far from all.
Sides* StretchAt(double outside_px, double inner_px, Junction* junction) {
  if (outside_px > 0) return IsBeside(outside_px) ? &junction->beyond : nullptr;
  if (inner_px < 0) return IsBeside(inner_px) ? &junction->within : nullptr;
  return std::min(-outside_px, inner_px) > kClearPx ? &junction->band : nullptr;
}

// ln of light; noise is no less than what is added.
double LogLight(const BladeView& view, const cv::Point& at) {
  constexpr double kDark = 0.002;
  return std::log(kDark + static_cast<double>(view.tone().linear[view.grey().at<uchar>(at)]));
}

Junction JunctionOf(const BladeView& view,
                    const StraightLine& border,
                    const StraightLine& inner,
                    const StraightLine& edge) {
  constexpr double kLeastSine = 0.1;  // between the edges
  Junction junction;
  const double sine = std::abs(Cross(border.normal(), edge.normal()));
  if (sine < kLeastSine) return junction;
  const Vector2d center = border.intersection(edge);
  const double width_px = std::max(0.0, inner.signedDistance(center));
  const int reach = static_cast<int>((width_px + kReachPx) / sine + 2 * kReachPx);
  const cv::Rect about(static_cast<int>(center.x()) - reach,
                       static_cast<int>(center.y()) - reach,
                       2 * reach,
                       2 * reach);
  const cv::Rect seen = about & cv::Rect(cv::Point(), view.grey().size());
  for (int y = seen.y; y < seen.br().y; ++y) {
    for (int x = seen.x; x < seen.br().x; ++x) {
      const Vector2d place(x, y);
      const double off_px = edge.signedDistance(place);
      if (!IsBeside(off_px)) continue;
      Sides* const sides =
          StretchAt(border.signedDistance(place), inner.signedDistance(place), &junction);
      if (!sides) continue;
      (off_px > 0 ? sides->beside : sides->blade).push_back(LogLight(view, {x, y}));
    }
  }
  return junction;
}

// By how much the band, half way along the blade, is brighter than the ground there or at the
// junction, the darker of both, as either may lie in a shadow; ln of light. Infinity where it is
// too narrow to tell.
double ExcessAlongBand(const BladeView& view,
                       const std::vector<LocatedEdgePoint>& border,
                       const std::vector<LocatedEdgePoint>& inner,
                       double at_junction) {
  constexpr double kFrom = 0.3, kTo = 0.7;  // of the edge
  constexpr double kBesidePx = 3;
  constexpr int kPlaces = 40;
  const cv::Rect picture(cv::Point(), view.grey().size());
  std::vector<double> band, ground;
  const auto add = [&](const Vector2d& place, std::vector<double>* light) {
    const cv::Point at = NearestPixel(place);
    if (picture.contains(at)) light->push_back(LogLight(view, at));
  };
  for (int k = 0; k < kPlaces; ++k) {
    const double share = kFrom + (kTo - kFrom) * k / kPlaces;
    const auto at = [&](const std::vector<LocatedEdgePoint>& edge) {
      return edge[static_cast<std::size_t>(share * static_cast<double>(edge.size()))];
    };
    const LocatedEdgePoint outer = at(border);
    const Vector2d middle = 0.5 * (outer.trend_px + at(inner).trend_px);
    if ((outer.trend_px - middle).dot(outer.normal) < kClearPx) continue;
    add(middle, &band);
    add(outer.trend_px + kBesidePx * outer.normal, &ground);
  }
  const bool is_seen = std::min(band.size(), ground.size()) > kPlaces / 2;
  if (!is_seen) return std::numeric_limits<double>::infinity();
  return Median(band) - std::min(Median(ground), at_junction);
}

}  // namespace

Occlusion OcclusionUpTo(const BladeView& view,
                        const std::vector<LocatedEdgePoint>& border,
                        const std::vector<LocatedEdgePoint>& inner,
                        const std::vector<LocatedEdgePoint>& other) {
  constexpr double kShows = 0.3;                // ln of light
  constexpr double kHidden = 0.3, kSeen = 0.6;  // of the edge's step
  constexpr double kOnTop = 0.5;
  constexpr double kGoesOn = 0.25;  // of what the band is brighter by at the junction
  if (border.empty() || inner.empty() || other.empty()) return Occlusion::kUntold;
  const auto [beyond, band, within] =
      JunctionOf(view, LineNearCrotch(border), LineNearCrotch(inner), LineNearCrotch(other));
  if (!beyond.AreSeen() || !band.AreSeen()) return Occlusion::kUntold;
  const double step = beyond.Step();
  if (std::abs(step) < kShows) return Occlusion::kUntold;
  const double left = band.Step() / step;
  const bool is_on_top = within.AreSeen() && std::abs(within.Step() / step) > kOnTop;
  if (left > kSeen) return is_on_top ? Occlusion::kOnTop : Occlusion::kNone;
  if (is_on_top || std::abs(left) > kHidden) return Occlusion::kUntold;
  // A bevel goes on beside the edge; what fills the crotch does not.
  const double ground = Median(beyond.beside), excess = Median(band.beside) - ground;
  const bool is_bevel =
      excess > 0 && ExcessAlongBand(view, border, inner, ground) > kGoesOn * excess;
  return is_bevel ? Occlusion::kHidden : Occlusion::kUntold;
}

Occlusion OcclusionBeside(const BladeView& view,
                          const LocatedEdge& edge,
                          double line_px,
                          const LocatedEdge& other) {
  const std::vector<LocatedEdgePoint> on_edge = InlyingPoints(edge, 0);
  const std::vector<LocatedEdgePoint> on_line = InlyingPoints(edge, line_px);
  const bool is_border = line_px < 0;
  return OcclusionUpTo(
      view, is_border ? on_edge : on_line, is_border ? on_line : on_edge, InlyingPoints(other, 0));
}

void ConfirmByOcclusion(const BladeView& view, const LocatedEdge& other, LocatedEdge* edge) {
  if (!(edge->rival_sigma_px > 0)) return;
  const Occlusion told = OcclusionBeside(view, *edge, edge->rival_px, other);
  const bool is_border = edge->rival_px > 0 ? IsSeenInBand(told) : told == Occlusion::kHidden;
  if (is_border) DropRival(edge);
}

}  // namespace bladecurve
