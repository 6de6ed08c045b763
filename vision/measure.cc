// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/measure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/blade_frame.h"
#include "vision/distal_end.h"
#include "vision/edge_debug.h"
#include "vision/edge_pair.h"
#include "vision/pivot.h"
#include "vision/refused.h"
#include "vision/scene.h"

namespace bladecurve {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Both cutting edges as located, and where they round off into the tips.
struct LocatedBlade {
  bool on_left = true;
  LocatedEdge edge;
  DistalEnd end;
  std::vector<LocatedEdgePoint> used;  // inliers between the crotch and the distal end
};

Vector2d DirectionInStored(const Photo& photo, Direction direction) {
  Vector2d displayed = Vector2d::Zero();
  switch (direction) {
    case Direction::kRight:
      displayed = {1, 0};
      break;
    case Direction::kLeft:
      displayed = {-1, 0};
      break;
    case Direction::kUp:
      displayed = {0, -1};
      break;
    case Direction::kDown:
      displayed = {0, 1};
      break;
  }
  return photo.StoredFromDisplayed(displayed) - photo.StoredFromDisplayed(Vector2d::Zero());
}

StoredHints InStored(const Photo& photo, const SceneHints& hints) {
  StoredHints stored;
  if (hints.pivot_px) stored.pivot_px = photo.StoredFromDisplayed(*hints.pivot_px);
  if (hints.tips_toward) stored.tips_direction = DirectionInStored(photo, *hints.tips_toward);
  if (hints.roi_px) {
    const auto& [x, y, width, height] = *hints.roi_px;
    const Vector2d a = photo.StoredFromDisplayed({x, y});
    const Vector2d b = photo.StoredFromDisplayed({x + width - 1, y + height - 1});
    const Vector2d low = a.cwiseMin(b);
    const Vector2d high = a.cwiseMax(b);
    stored.roi_px = cv::Rect(static_cast<int>(std::floor(low.x())),
                             static_cast<int>(std::floor(low.y())),
                             static_cast<int>(std::lround(high.x() - low.x())) + 1,
                             static_cast<int>(std::lround(high.y() - low.y())) + 1);
  }
  return stored;
}

std::vector<Vector2d> InlierPoints(const LocatedEdge& edge) {
  std::vector<Vector2d> points;
  for (const LocatedEdgePoint& p : edge.points) {
    if (p.inlier) points.push_back(p.point_px);
  }
  return points;
}

double MedianSigma(const std::vector<LocatedEdgePoint>& points) {
  std::vector<double> sigmas;
  for (const LocatedEdgePoint& p : points) sigmas.push_back(p.sigma_px);
  if (sigmas.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  return *middle;
}

// Keeps what lies between the crotch, where the other blade's edge is near, and the distal end.
void Trim(const Photo& photo, const Scene& scene, LocatedBlade* blade) {
  const Vector2d& crotch_px = scene.crotch_px;
  const std::vector<Vector2d> points = InlierPoints(blade->edge);
  const SceneBlade& seen = blade->on_left ? scene.left : scene.right;
  const double reach_px = std::max(8.0, 4 * scene.path_sigma_px);
  blade->end = FindDistalEnd(
      photo.grey(),
      points,
      {{seen.tip_px, reach_px, seen.width_px, blade->on_left}, MedianSigma(blade->edge.points)});
  const double blur = std::isfinite(blade->edge.blur_px) ? blade->edge.blur_px : 1;
  const double clear =
      4 * blur + 2;  // nearer to the crossing, light of the other blade's edge reaches this one
  // Near the end the windows of the edge fit, 50 px long, reach round the tip and bend the edge.
  constexpr double kSmearedPx = 20, kMostOfEdge = 0.05;
  const double smeared =
      points.empty() ? 0
                     : std::min(kSmearedPx, kMostOfEdge * (points.back() - points.front()).norm());
  std::size_t index = 0;
  for (const LocatedEdgePoint& p : blade->edge.points) {
    if (!p.inlier) continue;
    if (index++ >= blade->end.index) break;
    if ((p.point_px - crotch_px).norm() > clear &&
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

std::vector<Vector2d> PointsOf(const std::vector<LocatedEdgePoint>& located) {
  std::vector<Vector2d> points;
  for (const LocatedEdgePoint& p : located) points.push_back(p.point_px);
  return points;
}

// The distal end is known across the edge like a point of it, along the edge as found.
Matrix2d EndCovariance(const LocatedBlade& blade) {
  const Vector2d across = blade.used.back().normal;
  const Vector2d along(-across.y(), across.x());
  const double across_sigma = std::hypot(blade.used.back().sigma_px, blade.edge.common_sigma_px);
  return blade.end.along_sigma_px * blade.end.along_sigma_px * along * along.transpose() +
         across_sigma * across_sigma * across * across.transpose();
}

PlaneMap MapFor(const ScaleResult& scale,
                const ScaleOptions& options,
                const Pivot& pivot,
                const LocatedBlade& upper) {
  if (scale.map) return *scale.map;
  // --length-mm: the distance from the pivot to the upper distal end.
  const double length_px = (upper.end.point_px - pivot.point_px).norm();
  const double sigma_px =
      std::sqrt(pivot.covariance_px2.trace() / 2 + std::pow(upper.end.along_sigma_px, 2));
  return PlaneMap::Uniform(*options.length_mm / length_px, sigma_px / length_px, "length");
}

// Opening angle between the rays from the pivot to the distal ends, its uncertainty, and the
// direction halfway.
struct Opening {
  double theta_rad = 0, sigma_rad = 0;
  Vector2d x_in_plane;
};

Opening MeasureOpening(const PlaneMap& map,
                       const Pivot& pivot,
                       const LocatedBlade& upper,
                       const LocatedBlade& lower) {
  const auto in_plane = [&](const Vector2d& px) { return map.PlaneFromImage(px); };
  const auto angle = [&](const Vector2d& p, const Vector2d& u, const Vector2d& l) {
    const Vector2d a = in_plane(u) - in_plane(p);
    const Vector2d b = in_plane(l) - in_plane(p);
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  };
  Opening opening;
  opening.theta_rad = angle(pivot.point_px, upper.end.point_px, lower.end.point_px);
  const Vector2d a = (in_plane(upper.end.point_px) - in_plane(pivot.point_px)).normalized();
  const Vector2d b = (in_plane(lower.end.point_px) - in_plane(pivot.point_px)).normalized();
  opening.x_in_plane = (a + b).normalized();
  // First order, by differences of one pixel over the three points' coordinates.
  double variance = 0;
  const auto add = [&](const Matrix2d& covariance, const auto& moved) {
    Vector2d gradient;
    for (int k = 0; k < 2; ++k) gradient[k] = moved(Vector2d::Unit(k)) - opening.theta_rad;
    variance += gradient.dot(covariance * gradient);
  };
  add(pivot.covariance_px2, [&](const Vector2d& d) {
    return angle(pivot.point_px + d, upper.end.point_px, lower.end.point_px);
  });
  add(EndCovariance(upper), [&](const Vector2d& d) {
    return angle(pivot.point_px, upper.end.point_px + d, lower.end.point_px);
  });
  add(EndCovariance(lower), [&](const Vector2d& d) {
    return angle(pivot.point_px, upper.end.point_px, lower.end.point_px + d);
  });
  opening.sigma_rad = std::sqrt(variance);
  return opening;
}

void RefuseOutOfPlane(const Pivot& pivot) {
  // Straight and curved scissors seen at a slant reach 0.1, bandage scissors 0.25 and more.
  constexpr double kLargestAsymmetry = 0.2;
  if (pivot.asymmetry <= kLargestAsymmetry) return;
  throw Refused(
      Reason::kOutOfPlane,
      "pivot: the two cutting edges pass by the pivot at very different distances (" +
          std::to_string(pivot.asymmetry).substr(0, 4) +
          " of the blade's length); angled or bent blades cannot be measured from one view");
}

std::vector<EdgePoint> ToFrame(const BladeFrame& frame,
                               const std::vector<LocatedEdgePoint>& located) {
  std::vector<EdgePoint> points;
  points.reserve(located.size());
  for (const LocatedEdgePoint& p : located)
    points.push_back(frame.FromImage(p.point_px, p.normal, p.sigma_px));
  return points;
}

// What the points of the lower edge share is not told apart from what both edges share. Where the
// lower edge is the more doubtful one, its points become so uncertain that their mean is as
// doubtful as the edge.
std::vector<LocatedEdgePoint> DoubtedAlone(const LocatedBlade& lower, double upper_common_px) {
  std::vector<LocatedEdgePoint> points = lower.used;
  const double own_px = lower.edge.common_sigma_px;
  if (!(own_px > upper_common_px)) return points;
  const double length_px = (points.back().point_px - points.front().point_px).norm();
  const double independent = length_px / std::max(1.0, lower.edge.correlation_px);
  const double variance_px2 =
      (own_px * own_px - upper_common_px * upper_common_px) * std::max(1.0, independent);
  for (LocatedEdgePoint& point : points) {
    point.sigma_px = std::sqrt(point.sigma_px * point.sigma_px + variance_px2);
  }
  return points;
}

// Everything in mm that the fit needs.
EdgePoints ToEdgePoints(const BladeFrame& frame,
                        const PlaneMap& map,
                        const Pivot& pivot,
                        const LocatedBlade& upper,
                        const LocatedBlade& lower) {
  EdgePoints edges;
  edges.upper = ToFrame(frame, upper.used);
  edges.lower = ToFrame(frame, DoubtedAlone(lower, upper.edge.common_sigma_px));
  edges.pivot = frame.FromImage(pivot.point_px, pivot.covariance_px2);
  edges.upper_end = frame.FromImage(upper.end.point_px, EndCovariance(upper));
  edges.lower_end = frame.FromImage(lower.end.point_px, EndCovariance(lower));
  edges.scale_relative_sigma = map.relative_sigma();
  edges.correlation_length_mm = upper.edge.correlation_px * frame.mm_per_px();
  edges.common_offset_sigma_mm = upper.edge.common_sigma_px * frame.mm_per_px();
  return edges;
}

void CollectWarnings(const Scene& scene,
                     const PlaneMap& map,
                     const Pivot& pivot,
                     const LocatedBlade& upper,
                     const LocatedBlade& lower,
                     std::vector<std::string>* warnings) {
  constexpr double kSeveralTransitions = 0.5;
  constexpr double kSlanted = 0.1;
  *warnings = scene.warnings;
  warnings->insert(warnings->end(), map.warnings().begin(), map.warnings().end());
  if (pivot.source == "geometry") warnings->push_back("pivot_not_seen");
  if (pivot.asymmetry > kSlanted) warnings->push_back("blades_asymmetric");
  if (upper.edge.ambiguity > kSeveralTransitions) warnings->push_back("upper_edge_ambiguous");
  if (lower.edge.ambiguity > kSeveralTransitions) warnings->push_back("lower_edge_ambiguous");
}

}  // namespace

PhotoMeasurement MeasurePhoto(const std::filesystem::path& path, const MeasureOptions& options) {
  StageLog log(options.debug_dir);
  const Photo photo = Photo::Load(path);
  log.Ran("decode", "grey");
  const ScaleResult scale = FindScale(photo, options.scale);
  log.Ran("scale", scale.map ? scale.map->source() : "waits for the blades: --length-mm");
  const StoredHints hints = InStored(photo, options.hints);
  const Scene scene = FindScene(photo, scale.markers, hints, &log);

  const bool upper_on_left = options.hints.upper_is_left.value_or(true) != photo.mirrored();
  BladeEdges edges = LocateBlades(photo, scale.tone, scene, upper_on_left);
  if (log.wants_pictures()) {
    log.Picture("edge-upper", DrawEdge(photo.grey(), edges.upper));
    log.Picture("edge-lower", DrawEdge(photo.grey(), edges.lower));
  }
  LocatedBlade upper{upper_on_left, std::move(edges.upper), {}, {}};
  LocatedBlade lower{!upper_on_left, std::move(edges.lower), {}, {}};
  Trim(photo, scene, &upper);
  Trim(photo, scene, &lower);
  log.Ran("edges", "full resolution along the blades only");
  const LocatedBlade& left = upper_on_left ? upper : lower;
  const LocatedBlade& right = upper_on_left ? lower : upper;
  const Pivot pivot = FindPivot(
      photo.grey(), scale, {scene, {PointsOf(left.used), PointsOf(right.used)}, hints.pivot_px});
  RefuseOutOfPlane(pivot);
  log.Ran("pivot", pivot.source);

  const PlaneMap map = MapFor(scale, options.scale, pivot, upper);
  const Opening opening = MeasureOpening(map, pivot, upper, lower);
  const BladeFrame frame(map, pivot.point_px, opening.x_in_plane, upper_on_left);

  PhotoMeasurement result;
  result.file = path.string();
  result.sha256 = photo.metadata().sha256;
  result.width = photo.displayed_width();
  result.height = photo.displayed_height();
  result.pivot_px = photo.DisplayedFromStored(pivot.point_px);
  result.pivot_sigma_px = std::sqrt(pivot.covariance_px2.trace() / 2);
  result.pivot_source = pivot.source;
  result.axis_px = photo.DisplayedFromStored(pivot.point_px + frame.axis_px()) - result.pivot_px;
  result.theta_rad = options.hints.theta_rad.value_or(opening.theta_rad);
  result.theta_sigma_rad = opening.sigma_rad;
  result.theta_source = options.hints.theta_rad ? "given" : "distal-ends";
  result.mm_per_px = frame.mm_per_px();
  result.mm_per_px_sigma = frame.mm_per_px_sigma(pivot.covariance_px2);
  result.scale_source = map.source();
  result.edges = ToEdgePoints(frame, map, pivot, upper, lower);
  result.edges.photo = result.file;
  result.edges.theta_rad = result.theta_rad;
  result.edges.theta_sigma_rad = result.theta_sigma_rad;
  result.edges.theta_given = options.hints.theta_rad.has_value();
  for (const LocatedEdgePoint& p : upper.used)
    result.upper_edge_px.push_back(photo.DisplayedFromStored(p.trend_px));
  for (const LocatedEdgePoint& p : lower.used)
    result.lower_edge_px.push_back(photo.DisplayedFromStored(p.trend_px));
  for (const LocatedEdgePoint& p : upper.used)
    result.upper_edge_mm.push_back(frame.FromImage(p.trend_px));
  result.upper_edge_sigma_px = std::hypot(MedianSigma(upper.used), upper.edge.common_sigma_px);
  result.upper_end_px = photo.DisplayedFromStored(upper.end.point_px);
  result.lower_end_px = photo.DisplayedFromStored(lower.end.point_px);
  CollectWarnings(scene, map, pivot, upper, lower, &result.warnings);
  log.Ran("pose", "opening angle and axis from the distal ends");
  result.plan = log.records();
  result.ms_total = log.total_ms();
  return result;
}

}  // namespace bladecurve
