// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/located_blade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "vision/edge/edge_curve.h"
#include "vision/image/covariance.h"
#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"
#include "vision/refused.h"
#include "vision/scissors/scene_guess.h"
#include "vision/scissors/tip_arc.h"

namespace bladecurve {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

std::vector<Vector2d> InlierPoints(const LocatedEdge& edge) {
  std::vector<Vector2d> points;
  for (const LocatedEdgePoint& p : edge.points) {
    if (p.inlier) points.push_back(p.point_px);
  }
  return points;
}

// Nearer to the crossing, light of the other blade's edge reaches this one. px.
double ClearOfCrossing(const LocatedEdge& edge) {
  const double blur = BlurOr(edge, 1);
  return 4 * blur + 2;
}

// Near the end the windows of the edge fit, 50 px long and of long edges twice that, reach round
// the tip and bend the edge. px.
double SmearedByTip(const std::vector<Vector2d>& points) {
  constexpr double kSmearedPx = 56, kMostOfEdge = 0.10;
  if (points.empty()) return 0;
  return std::min(kSmearedPx, kMostOfEdge * (points.back() - points.front()).norm());
}

// What is uncertain about where the edge lies, beside a part of that. px^2.
double VarianceBeside(double part_px, const LocatedEdge& edge) {
  return std::max(0.0, edge.common_sigma_px * edge.common_sigma_px - part_px * part_px);
}

// Of an offset that the edge may have, how much the other edge of the pair may have as well. px.
double ShareableSigma(const LocatedEdge& edge) {
  return std::sqrt(VarianceBeside(edge.alone_sigma_px, edge));
}

// Whether the piece from a0 to a1 crosses that from b0 to b1.
bool CrossEachOther(const Vector2d& a0,
                    const Vector2d& a1,
                    const Vector2d& b0,
                    const Vector2d& b1) {
  const auto apart =
      [](const Vector2d& from, const Vector2d& to, const Vector2d& p, const Vector2d& q) {
        return Cross(to - from, p - from) * Cross(to - from, q - from) <= 0;
      };
  return apart(a0, a1, b0, b1) && apart(b0, b1, a0, a1);
}

// The last place, in their first halves, at which two edges cross; nothing where they do not.
std::optional<Vector2d> CrossingOf(const std::vector<LocatedEdgePoint>& a,
                                   const std::vector<LocatedEdgePoint>& b) {
  for (std::size_t i = a.size() / 2; i > 0; --i) {
    for (std::size_t j = b.size() / 2; j > 0; --j) {
      if (CrossEachOther(a[i - 1].trend_px, a[i].trend_px, b[j - 1].trend_px, b[j].trend_px))
        return 0.5 * (a[i].trend_px + b[j].trend_px);
    }
  }
  return std::nullopt;
}

// Of the points used those further along than `from_px`, and clear of it.
std::vector<LocatedEdgePoint> Beyond(const Vector2d& from_px, const LocatedBlade& blade) {
  const Vector2d along = (blade.used.back().trend_px - from_px).normalized();
  const double clear = ClearOfCrossing(blade.edge);
  std::vector<LocatedEdgePoint> kept;
  for (const LocatedEdgePoint& p : blade.used) {
    if ((p.point_px - from_px).dot(along) > clear) kept.push_back(p);
  }
  return kept;
}

// How far before its end an edge is lost: from its last point that counts on.
double LostPx(const LocatedEdge& edge) {
  const std::size_t seen = edge.points.size() - LostPoints(edge);
  return seen == 0 ? 0 : (edge.points.back().trend_px - edge.points[seen - 1].trend_px).norm();
}

// Where the tip's arc leaves the edge in colours that part blade and ground much better than grey
// does, if it is seen there.
std::optional<DistalEnds> EndsInColours(const BladeView& view,
                                        std::vector<Vector2d> points,
                                        EndSearch search) {
  if (points.size() < kFewestEdgePoints) return std::nullopt;
  EdgeGuess guess{points, search.tip.blade_on_left, 0.5 * search.tip.reach_px};
  guess.path_px.push_back(points.back() + search.tip.blade_width_px * AlongChord(points));
  const std::optional<ColourView> colours = view.InBetterColours(guess);
  if (!colours) return std::nullopt;
  for (Vector2d& p : points) p -= colours->corner_px;
  search.tip.tip_px -= colours->corner_px;
  DistalEnds ends = FindDistalEnds(colours->grey, points, search);
  if (!ends.likely.arc_seen) return std::nullopt;
  ends.likely.point_px += colours->corner_px;
  for (DistalEnd& rival : ends.rivals) rival.point_px += colours->corner_px;
  return ends;
}

}  // namespace

void TrimToFree(const BladeView& view, LocatedBlade* blade, const std::vector<Vector2d>& beyond) {
  constexpr double kOfLost = 0.2;  // of what is lost of the edge, standard
  std::vector<Vector2d> points = InlierPoints(blade->edge);
  points.insert(points.end(), beyond.begin(), beyond.end());
  const SceneBlade& seen = BladeOf(view.scene(), blade->on_left);
  const double reach_px = std::max(8.0, 4 * view.scene().path_sigma_px);
  TipSearch tip{seen.tip_px, reach_px, seen.width_px, blade->on_left};
  tip.blur_px = BlurOr(blade->edge, tip.blur_px);
  const EndSearch search{tip, MedianSigma(blade->edge.points)};
  DistalEnds ends = FindDistalEnds(view.grey(), points, search);
  if (!ends.likely.arc_seen) {
    if (auto coloured = EndsInColours(view, points, search)) ends = *std::move(coloured);
  }
  blade->end = ends.likely;
  if (!blade->end.arc_seen)
    blade->end.along_sigma_px =
        std::hypot(blade->end.along_sigma_px, kOfLost * LostPx(blade->edge));
  blade->rival_ends = std::move(ends.rivals);
  KeepFree(view.scene(), blade);
}

void KeepFree(const Scene& scene, LocatedBlade* blade) {
  const std::vector<Vector2d> points = InlierPoints(blade->edge);
  const double clear = ClearOfCrossing(blade->edge);
  const double smeared = SmearedByTip(points);
  std::size_t index = 0;
  blade->used.clear();
  for (const LocatedEdgePoint& p : blade->edge.points) {
    if (!p.inlier) continue;
    if (index++ >= blade->end.index) break;
    if ((p.point_px - scene.crotch_px).norm() > clear &&
        (p.point_px - blade->end.point_px).norm() > smeared) {
      blade->used.push_back(p);
    }
  }
  constexpr std::size_t kFewest = 20;  // a shorter edge says little about a curve
  if (blade->used.size() < kFewest) {
    throw Refused(Reason::kEdgeTooShort,
                  "edges: only " + std::to_string(blade->used.size()) +
                      " px of free cutting edge; open the scissors wider or go nearer");
  }
}

void KeepBeyondCrossing(Blades* blades) {
  const std::optional<Vector2d> crossing = CrossingOf(blades->upper.used, blades->lower.used);
  if (!crossing) return;
  std::vector<LocatedEdgePoint> upper = Beyond(*crossing, blades->upper);
  std::vector<LocatedEdgePoint> lower = Beyond(*crossing, blades->lower);
  if (2 * upper.size() < blades->upper.used.size() || 2 * lower.size() < blades->lower.used.size())
    return;
  blades->upper.used = std::move(upper);
  blades->lower.used = std::move(lower);
}

std::size_t InliersBefore(const LocatedEdge& edge,
                          const Vector2d& place_px,
                          const Vector2d& along) {
  std::size_t count = 0;
  for (const LocatedEdgePoint& p : edge.points) {
    if (!p.inlier) continue;
    if ((p.point_px - place_px).dot(along) > 0) break;
    ++count;
  }
  return count;
}

void PlaceEndOnCourse(LocatedBlade* blade) {
  const std::optional<PlaceOnCourse> place =
      AbreastOnCourse(blade->edge.points,
                      {blade->edge.correlation_px, SmearedByTip(InlierPoints(blade->edge))},
                      blade->end.point_px);
  if (!place) return;
  blade->end.point_px = place->point_px;
  blade->end.across_sigma_px = place->across_sigma_px;
}

Matrix2d EndCovariance(const LocatedBlade& blade, double shared_px) {
  const Vector2d across = blade.used.back().normal;
  const Vector2d along(-across.y(), across.x());
  const double across_sigma = std::hypot(blade.used.back().sigma_px,
                                         std::sqrt(VarianceBeside(shared_px, blade.edge)),
                                         blade.end.across_sigma_px);
  return AlongAcross(along, blade.end.along_sigma_px, across_sigma);
}

std::vector<Vector2d> PointsOf(const LocatedBlade& blade) {
  std::vector<Vector2d> points;
  for (const LocatedEdgePoint& p : blade.used) points.push_back(p.point_px);
  return points;
}

double MedianSigma(const std::vector<LocatedEdgePoint>& points) {
  if (points.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sigmas;
  for (const LocatedEdgePoint& p : points) sigmas.push_back(p.sigma_px);
  return Median(std::move(sigmas));
}

double EdgeSigmaPx(const LocatedBlade& blade) {
  return std::hypot(MedianSigma(blade.used), blade.edge.common_sigma_px);
}

std::vector<LocatedEdgePoint> DoubtedAlone(const LocatedBlade& lower, const LocatedBlade& upper) {
  std::vector<LocatedEdgePoint> points = lower.used;
  const double shared_px = std::min(ShareableSigma(lower.edge), ShareableSigma(upper.edge));
  const double apart_px2 =
      VarianceBeside(shared_px, lower.edge) + VarianceBeside(shared_px, upper.edge);
  if (!(apart_px2 > 0)) return points;
  const double length_px = (points.back().point_px - points.front().point_px).norm();
  const double independent = length_px / std::max(1.0, lower.edge.correlation_px);
  const double variance_px2 = apart_px2 * std::max(1.0, independent);
  for (LocatedEdgePoint& point : points) {
    point.sigma_px = std::sqrt(point.sigma_px * point.sigma_px + variance_px2);
  }
  return points;
}

}  // namespace bladecurve
