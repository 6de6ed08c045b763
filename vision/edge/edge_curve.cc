// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_curve.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr int kTerms =
    5;  // a quartic: blades with one bend are followed to a few tenths of a pixel
constexpr int kRounds = 12;
constexpr size_t kEnoughPoints = 300;  // points; more do not move a quartic
constexpr double kLeastSigma = 0.2;    // px; no point is worth more, whatever its noise
constexpr double kScale = 0.5;         // px; residuals beyond lose their pull (Cauchy)

using Terms = Eigen::Matrix<double, kTerms, 1>;

// Legendre polynomials at t in [-1, 1].
Terms LegendreTerms(double t) {
  Terms terms;
  terms[0] = 1;
  terms[1] = t;
  for (int n = 1; n + 1 < kTerms; ++n)
    terms[n + 1] = ((2 * n + 1) * t * terms[n] - n * terms[n - 1]) / (n + 1);
  return terms;
}

size_t SizeOf(const PointRange& range) { return range.last - range.first + 1; }

// Runs of inlying points without a gap.
std::vector<PointRange> RunsOf(const std::vector<LocatedEdgePoint>& points) {
  constexpr double kGapPx = 8;  // shorter ones are single outliers
  std::vector<PointRange> runs;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].inlier) continue;
    const bool joined =
        !runs.empty() && (points[i].point_px - points[runs.back().last].point_px).norm() < kGapPx;
    if (joined) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i});
    }
  }
  return runs;
}

// The course of an edge over a stretch of it, in the frame of the stretch's chord: how far across
// the chord a cubic of the place along it lies.
class Course {
 public:
  Course(const std::vector<LocatedEdgePoint>& points, const PointRange& stretch)
      : origin_px_(points[stretch.first].point_px),
        along_(points[stretch.last].point_px - origin_px_),
        across_(Vector2d(-along_.y(), along_.x()).normalized()) {
    Matrix4d normal = 1e-9 * Matrix4d::Identity();
    Vector4d right = Vector4d::Zero();
    for (size_t i = stretch.first; i <= stretch.last; ++i) {
      if (!points[i].inlier) continue;
      const Vector4d row = RowAt(points[i].point_px);
      normal += row * row.transpose();
      right += across_.dot(points[i].point_px - origin_px_) * row;
    }
    cubic_ = normal.ldlt().solve(right);
  }

  // Median distance of the inlying points of a stretch.
  [[nodiscard]] double DistanceOf(const std::vector<LocatedEdgePoint>& points,
                                  const PointRange& stretch) const {
    std::vector<double> distances;
    for (size_t i = stretch.first; i <= stretch.last; ++i) {
      if (points[i].inlier) distances.push_back(Distance(points[i].point_px));
    }
    return MedianAbsolute(distances);
  }

 private:
  [[nodiscard]] double Distance(const Vector2d& point_px) const {
    return across_.dot(point_px - origin_px_) - cubic_.dot(RowAt(point_px));
  }

  [[nodiscard]] Vector4d RowAt(const Vector2d& point_px) const {
    const double t = 2 * along_.dot(point_px - origin_px_) / along_.squaredNorm() - 1;
    return {1, t, t * t, t * t * t};
  }

  Vector2d origin_px_, along_, across_;
  Vector4d cubic_;
};

// Whether a run beyond a gap leaves the course of the stretch before the gap. Longer than the gap,
// it is the edge's own bend; too far out for a cubic to be continued, nobody knows.
bool Leaves(const std::vector<LocatedEdgePoint>& points,
            const PointRange& stretch,
            const PointRange& run) {
  constexpr double kTolerance = 0.6;  // px; what a cubic continued over a gap may be off
  constexpr double kSpreads = 4;
  constexpr double kFarthest = 0.5;  // of the stretch's length, from it to the run's far end
  const auto apart = [&](size_t a, size_t b) {
    return (points[a].point_px - points[b].point_px).norm();
  };
  const double gap_px =
      run.first > stretch.last ? apart(stretch.last, run.first) : apart(run.last, stretch.first);
  const double run_px = apart(run.first, run.last);
  if (run_px >= gap_px) return false;
  if (gap_px + run_px > kFarthest * apart(stretch.first, stretch.last)) return false;
  const Course course(points, stretch);
  return course.DistanceOf(points, run) >
         kTolerance + kSpreads * course.DistanceOf(points, stretch);
}

void Reject(size_t first, size_t end, std::vector<LocatedEdgePoint>& points) {
  for (size_t i = first; i < end; ++i) points[i].inlier = false;
}

// Of a least-squares fit whose last residual was `distance_px`.
double WeightOf(const LocatedEdgePoint& point, double distance_px) {
  const double pull = 1 / (1 + distance_px * distance_px / (kScale * kScale));
  return pull / (point.sigma_px * point.sigma_px + kLeastSigma * kLeastSigma);
}

// A point of an edge's distal part, in the frame of the chord from the edge's first point to a
// place.
struct DistalPoint {
  const LocatedEdgePoint* point;
  Vector4d row;  // powers of the way along the chord, -1 at its start and 0 at the place
  double across_px = 0;
};

std::vector<DistalPoint> DistalPoints(const std::vector<LocatedEdgePoint>& points,
                                      const Vector2d& along,
                                      const Vector2d& across,
                                      double to) {
  constexpr double kFrom = -0.6;  // of the way, from the place
  std::vector<DistalPoint> distal;
  for (const LocatedEdgePoint& point : points) {
    const Vector2d from_origin = point.point_px - points.front().point_px;
    const double u = from_origin.dot(along) / along.squaredNorm() - 1;
    if (point.inlier && u > kFrom && u < to)
      distal.push_back({&point, {1, u, u * u, u * u * u}, from_origin.dot(across)});
  }
  return distal;
}

// Of a robust cubic at the place.
struct Offset {
  double px = 0, sigma_px = 0;
};

// Errors of points nearer to each other than `correlation_px` go together. Third order is expected
// to be a hundredth of the way, as blades have it: points that say little about it do not carry the
// cubic away where it is continued.
Offset OffsetAtPlace(const std::vector<DistalPoint>& distal, double way_px, double correlation_px) {
  constexpr double kUsualThird = 0.012;
  const double seen_px = (distal.back().row[1] - distal.front().row[1]) * way_px;
  const double together =
      std::max(1.0, correlation_px * static_cast<double>(distal.size()) / std::max(1.0, seen_px));
  const Vector4d prior = Vector4d::UnitW() * std::pow(kUsualThird * way_px, -2) * together;
  Vector4d cubic = Vector4d::Zero();
  Offset offset;
  for (int round = 0; round < kRounds; ++round) {
    Matrix4d normal = prior.asDiagonal(), scatter = prior.asDiagonal();
    Vector4d right = Vector4d::Zero();
    for (const DistalPoint& at : distal) {
      const double distance_px = round == 0 ? 0 : at.across_px - cubic.dot(at.row);
      const double weight = WeightOf(*at.point, distance_px);
      normal += weight * at.row * at.row.transpose();
      scatter += std::pow(weight * at.point->sigma_px, 2) * at.row * at.row.transpose();
      right += weight * at.across_px * at.row;
    }
    const auto solver = normal.ldlt();
    cubic = solver.solve(right);
    const Vector4d gain = solver.solve(Vector4d(Vector4d::UnitX()));
    offset = {cubic[0], std::sqrt(gain.dot(scatter * gain) * together)};
  }
  return offset;
}

double DistanceFrom(const Vector2d& on_curve, const LocatedEdgePoint& point) {
  return point.normal.dot(point.point_px - on_curve);
}

double PlaceOf(size_t i, size_t count) {
  return count > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1 : 0;
}

}  // namespace

std::vector<Vector2d> PlainCurve(const std::vector<LocatedEdgePoint>& points) {
  std::vector<Vector2d> curve(points.size());
  const size_t stride = 1 + points.size() / kEnoughPoints;
  std::vector<Terms> terms;
  for (size_t i = 0; i < points.size(); ++i)
    terms.push_back(LegendreTerms(PlaceOf(i, points.size())));
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Eigen::Matrix<double, kTerms, 2> right = Eigen::Matrix<double, kTerms, 2>::Zero();
    for (size_t i = 0; i < points.size(); i += stride) {
      const double weight = WeightOf(points[i], round == 0 ? 0 : DistanceFrom(curve[i], points[i]));
      normal += weight * terms[i] * terms[i].transpose();
      right += weight * terms[i] * (points[i].point_px - points.front().point_px).transpose();
    }
    const Eigen::Matrix<double, kTerms, 2> coefficients = normal.ldlt().solve(right);
    const size_t wanted = round + 1 < kRounds ? stride : 1;
    for (size_t i = 0; i < points.size(); i += wanted)
      curve[i] = points.front().point_px + coefficients.transpose() * terms[i];
  }
  return curve;
}

std::vector<double> DistancesFromPlainCurve(const std::vector<LocatedEdgePoint>& points) {
  const std::vector<Vector2d> curve = PlainCurve(points);
  std::vector<double> distances;
  for (size_t i = 0; i < points.size(); ++i) distances.push_back(DistanceFrom(curve[i], points[i]));
  return distances;
}

double OffPlainCurve(const std::vector<LocatedEdgePoint>& points, double share) {
  const std::vector<Vector2d> curve = PlainCurve(points);
  std::vector<double> off;
  for (size_t i = 0; i < points.size(); ++i)
    off.push_back(std::abs(points[i].normal.dot(points[i].trend_px - curve[i])));
  return SampleQuantile(std::move(off), share);
}

std::optional<PlaceOnCourse> AbreastOnCourse(const std::vector<LocatedEdgePoint>& points,
                                             const CourseDoubt& doubt,
                                             const Vector2d& place_px) {
  constexpr double kWidestGap = 0.15;      // of the way to the place, that a cubic may bridge
  constexpr double kOffBeyondGap = 0.005;  // of the way, that the place is off beyond a wider one
  constexpr size_t kFewest = 20;
  if (points.empty()) return std::nullopt;
  const Vector2d along = place_px - points.front().point_px;
  const double way_px = along.norm();
  const Vector2d across = Vector2d(-along.y(), along.x()) / way_px;
  const std::vector<DistalPoint> distal = DistalPoints(points, along, across, 0);
  if (distal.size() < kFewest) return std::nullopt;
  const Offset offset = OffsetAtPlace(distal, way_px, doubt.correlation_px);
  const std::vector<DistalPoint> clear =
      DistalPoints(points, along, across, -doubt.smeared_px / way_px);
  const double moved_px = clear.size() < kFewest
                              ? 0
                              : offset.px - OffsetAtPlace(clear, way_px, doubt.correlation_px).px;
  const bool bridged = distal.back().row[1] > -kWidestGap;
  const double alone_px = bridged ? 0 : std::hypot(kOffBeyondGap * way_px, offset.px);
  return PlaceOnCourse{place_px + (bridged ? offset.px : 0) * across,
                       std::hypot(offset.sigma_px, moved_px, alone_px)};
}

double LeavesCourseBy(const std::vector<LocatedEdgePoint>& points,
                      const PointRange& stretch,
                      const PointRange& run) {
  return Course(points, stretch).DistanceOf(points, run);
}

bool RejectDetachedEnds(std::vector<LocatedEdgePoint>& points) {
  constexpr double kMost =
      0.5;  // of the points; a shorter stretch does not say how an edge goes on
  const std::vector<PointRange> runs = RunsOf(points);
  if (runs.size() < 2) return false;
  const auto longest =
      std::max_element(runs.begin(), runs.end(), [](const PointRange& a, const PointRange& b) {
        return SizeOf(a) < SizeOf(b);
      });
  if (static_cast<double>(SizeOf(*longest)) < kMost * static_cast<double>(points.size()))
    return false;
  PointRange known = *longest;
  bool rejected = false;
  for (auto next = std::next(longest); next != runs.end(); ++next) {
    if (Leaves(points, known, *next)) {
      Reject(next->first, points.size(), points);
      rejected = true;
      break;
    }
    known.last = next->last;
  }
  for (auto before = std::make_reverse_iterator(longest); before != runs.rend(); ++before) {
    if (Leaves(points, known, *before)) {
      Reject(0, before->last + 1, points);
      rejected = true;
      break;
    }
    known.first = before->first;
  }
  return rejected;
}

}  // namespace bladecurve
