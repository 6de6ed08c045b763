// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/fit_data.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vision/refused.h"

namespace bladecurve {
namespace {

// Nothing is known better than this fraction of the blade's length: keeps exact observations (sigma
// 0) solvable.
constexpr double kSmallestSigma = 1e-9;
// Edge points, distal ends and the offset they share are not believed to more than this part of the
// blade's length, 0.1 um for common scissors: beyond that the weights of points and of poses no
// longer fit into one double, and no photograph comes near.
constexpr double kSmallestEdgeSigma = 2e-6;
// A theta given without sigma: a protractor read to half a degree.
constexpr double kGivenThetaSigma = 0.5 * std::numbers::pi / 180;
// Distal ends nearer to the pivot than this part of the edge's reach were not observed.
constexpr double kNoEnd = 1e-3;

[[noreturn]] void Refuse(const EdgePoints& photo, Reason reason, const std::string& what) {
  throw Refused(reason, "fit: " + photo.photo + ": " + what);
}

void CheckEdge(const EdgePoints& photo, const std::vector<EdgePoint>& edge, const char* name) {
  for (size_t i = 0; i < edge.size(); ++i) {
    if (!edge[i].point_mm.allFinite() || !std::isfinite(edge[i].sigma_mm)) {
      Refuse(photo, Reason::kFitFailed, name + (" point " + std::to_string(i)) + " is not finite");
    }
    if (edge[i].sigma_mm <= 0) {
      Refuse(photo,
             Reason::kFitFailed,
             name + (" point " + std::to_string(i)) + " has a sigma that is not > 0");
    }
  }
}

void CheckFinite(const EdgePoints& photo) {
  CheckEdge(photo, photo.upper, "upper");
  CheckEdge(photo, photo.lower, "lower");
  for (const LocatedPoint* point : {&photo.pivot, &photo.upper_end, &photo.lower_end}) {
    if (!point->point_mm.allFinite() || !point->covariance_mm2.allFinite()) {
      Refuse(photo, Reason::kFitFailed, "pivot or distal end is not finite");
    }
  }
  if (photo.theta_given && !std::isfinite(photo.theta_rad)) {
    Refuse(photo, Reason::kFitFailed, "the given theta is not finite");
  }
  for (const double value :
       {photo.scale_relative_sigma, photo.correlation_length_mm, photo.common_offset_sigma_mm}) {
    if (!std::isfinite(value) || value < 0) {
      Refuse(photo, Reason::kFitFailed, "a sigma or a length is negative or not finite");
    }
  }
}

// From the pivot to the upper edge's farthest point.
Eigen::Vector2d Farthest(const EdgePoints& photo) {
  Eigen::Vector2d farthest = Eigen::Vector2d::Zero();
  for (const EdgePoint& p : photo.upper) {
    const Eigen::Vector2d from_pivot = p.point_mm - photo.pivot.point_mm;
    if (from_pivot.squaredNorm() > farthest.squaredNorm()) farthest = from_pivot;
  }
  return farthest;
}

double FarthestReach(const EdgePoints& photo) { return Farthest(photo).norm(); }

double Reach(const EdgePoints& photo) {
  const double farthest = FarthestReach(photo);
  const double end = (photo.upper_end.point_mm - photo.pivot.point_mm).norm();
  return end > kNoEnd * farthest ? end : farthest;
}

// L with L L^T = covariance, sigma not below the smallest.
Eigen::Matrix2d Root(const Eigen::Matrix2d& covariance_mm2, double length_mm, double smallest) {
  const Eigen::Matrix2d floor = Eigen::Matrix2d::Identity() * (smallest * smallest);
  return Eigen::LLT<Eigen::Matrix2d>(covariance_mm2 / (length_mm * length_mm) + floor).matrixL();
}

void CheckCovariance(const EdgePoints& photo, const Eigen::Matrix2d& covariance) {
  const double trace = covariance.trace();
  if (trace < 0 || covariance.determinant() < -1e-9 * trace * trace) {
    Refuse(photo, Reason::kFitFailed, "a covariance is not positive semidefinite");
  }
}

// Order along the blade; points that coincide are one observation, not several.
std::vector<int> OrderAlong(const std::vector<EdgePoint>& edge, const Eigen::Vector2d& direction) {
  std::vector<double> place(edge.size());
  for (size_t i = 0; i < edge.size(); ++i) place[i] = direction.dot(edge[i].point_mm);
  const auto before = [&](int a, int b) {
    if (place[a] != place[b]) return place[a] < place[b];
    const Eigen::Vector2d& qa = edge[a].point_mm;
    const Eigen::Vector2d& qb = edge[b].point_mm;
    return qa.x() != qb.x() ? qa.x() < qb.x() : (qa.y() != qb.y() ? qa.y() < qb.y() : a < b);
  };
  std::vector<int> order(edge.size());
  std::iota(order.begin(), order.end(), 0);
  // Edges mostly come in order; looking first is cheaper than sorting.
  if (!std::is_sorted(order.begin(), order.end(), before)) {
    std::sort(order.begin(), order.end(), before);
  }
  const auto same = [&](int a, int b) { return edge[a].point_mm == edge[b].point_mm; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  return order;
}

// Points closer than the correlation length count once: the mean of n points of spacing d then has
// the variance sigma^2 l/(n d), as for noise that was smoothed by a box of length l.
double Inflation(int points, double edge_length, double correlation_length) {
  if (points < 2 || edge_length <= 0) return 1;
  const double spacing = edge_length / (points - 1);
  return std::sqrt(std::clamp(correlation_length / spacing, 1.0, points / 3.0 + 1.0));
}

EdgeSamples ScaledEdge(const EdgePoints& photo,
                       const std::vector<EdgePoint>& edge,
                       const Eigen::Vector2d& direction,
                       double length_mm) {
  EdgeSamples samples;
  double arc_mm = 0;
  for (const int i : OrderAlong(edge, direction)) {
    const Eigen::Vector2d point = (edge[i].point_mm - photo.pivot.point_mm) / length_mm;
    if (!samples.empty()) arc_mm += (point - samples.points.back()).dot(direction) * length_mm;
    samples.points.push_back(point);
    samples.weights.push_back(1 / std::max(edge[i].sigma_mm / length_mm, kSmallestEdgeSigma));
    samples.indices.push_back(i);
  }
  samples.inflation = Inflation(samples.size(), arc_mm, photo.correlation_length_mm);
  for (double& w : samples.weights) w /= samples.inflation;
  return samples;
}

double Angle(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

double WeightOf(double sigma) { return 1 / std::max(sigma, kSmallestSigma); }

void SetUpperEnd(const EdgePoints& photo, double length_mm, PhotoData& data) {
  const Eigen::Vector2d end = (photo.upper_end.point_mm - photo.pivot.point_mm) / length_mm;
  Eigen::Matrix2d covariance = photo.upper_end.covariance_mm2;
  data.upper_end = end;
  if (end.norm() * length_mm <= kNoEnd * FarthestReach(photo)) {
    // Not observed: the last edge point, known to a fiftieth of the blade's length.
    data.upper_end = data.upper.points.back();
    covariance = Eigen::Matrix2d::Identity() * std::pow(0.02 * length_mm, 2);
  }
  data.upper_end_whitener = Root(covariance, length_mm, kSmallestEdgeSigma).inverse();
}

void SetLowerEnd(const EdgePoints& photo, double length_mm, PhotoData& data) {
  const Eigen::Vector2d end = (photo.lower_end.point_mm - photo.pivot.point_mm) / length_mm;
  if (end.norm() * length_mm <= kNoEnd * FarthestReach(photo)) return;
  data.lower_end = end;
  data.lower_end_root = Root(photo.lower_end.covariance_mm2, length_mm, kSmallestEdgeSigma);
}

// Across an edge where it ends, out of the upper or the lower blade: its direction over the last
// two quarters, continued. Across the ray where no edge is known.
Eigen::Vector2d OutOfBlade(const EdgeSamples& edge, const Eigen::Vector2d& end, bool is_upper) {
  Eigen::Vector2d along = end.normalized();
  if (!edge.empty()) {
    const size_t last_at = edge.points.size() - 1;
    const Eigen::Vector2d& half = edge.points[last_at / 2];
    const Eigen::Vector2d& three_quarters = edge.points[last_at * 3 / 4];
    const Eigen::Vector2d before = (three_quarters - half).normalized();
    const Eigen::Vector2d last = (end - three_quarters).normalized();
    along = (1.5 * last - 0.5 * before).normalized();
  }
  return is_upper ? Eigen::Vector2d(along.y(), -along.x()) : Eigen::Vector2d(-along.y(), along.x());
}

// theta_rad that came from the ends says nothing beyond them, unless the lower end is missing.
void SetTheta(const EdgePoints& photo, PhotoData& data) {
  data.theta_given = photo.theta_given;
  data.view_theta_sigma = photo.theta_given ? 0 : photo.view_theta_sigma_rad;
  if (!photo.theta_given && data.lower_end) return;
  if (!std::isfinite(photo.theta_rad)) {
    Refuse(photo, Reason::kFitFailed, "neither the lower distal end nor theta is known");
  }
  data.theta = photo.theta_rad;
  const bool has_sigma = std::isfinite(photo.theta_sigma_rad) && photo.theta_sigma_rad > 0;
  data.theta_weight = WeightOf(has_sigma ? photo.theta_sigma_rad : kGivenThetaSigma);
}

// Of the ends' rays; theta where there is no lower end.
double AngleBetweenEnds(const PhotoData& data) {
  if (!data.lower_end) return *data.theta;
  return std::remainder(Angle(data.upper_end) - Angle(*data.lower_end), 2 * std::numbers::pi);
}

// Blade frames along the rays to the ends; a given theta turns both by half the difference.
void SetStart(PhotoData& data) {
  const double upper = Angle(data.upper_end), rays = AngleBetweenEnds(data);
  const double turn = data.ObservedTheta() - rays;
  data.start = {0, 0, upper + turn / 2, upper - rays - turn / 2, 0, 0};
}

PhotoData Prepare(const EdgePoints& photo, double length_mm) {
  PhotoData data;
  data.name = photo.photo;
  data.origin_mm = photo.pivot.point_mm;
  data.upper = ScaledEdge(photo, photo.upper, Farthest(photo).normalized(), length_mm);
  if (data.upper.size() < 3) {
    Refuse(photo,
           Reason::kEdgeTooShort,
           std::to_string(data.upper.size()) + " different points of the upper edge; 3 are needed");
  }
  SetUpperEnd(photo, length_mm, data);
  SetLowerEnd(photo, length_mm, data);
  SetTheta(photo, data);
  SetStart(data);
  if (!photo.lower.empty()) {
    const double angle = data.start[kLowerAngle];
    data.lower = ScaledEdge(photo, photo.lower, {std::cos(angle), std::sin(angle)}, length_mm);
  }
  data.upper_end_out = OutOfBlade(data.upper, data.upper_end, true);
  data.lower_end_out =
      OutOfBlade(data.lower, data.lower_end.value_or(Eigen::Vector2d::UnitX()), false);
  data.pivot_whitener = Root(photo.pivot.covariance_mm2, length_mm, kSmallestSigma).inverse();
  data.scale_weight = WeightOf(photo.scale_relative_sigma);
  data.offset_weight =
      WeightOf(std::max(photo.common_offset_sigma_mm / length_mm, kSmallestEdgeSigma));
  return data;
}

}  // namespace

double PhotoData::ObservedTheta() const { return theta ? *theta : AngleBetweenEnds(*this); }

bool FitData::theta_given() const {
  return std::any_of(
      photos.begin(), photos.end(), [](const PhotoData& p) { return p.theta_given; });
}

FitData PrepareFitData(const std::vector<EdgePoints>& photos) {
  double reach_mm = 0;
  for (const EdgePoints& photo : photos) {
    CheckFinite(photo);
    for (const LocatedPoint* point : {&photo.pivot, &photo.upper_end, &photo.lower_end}) {
      CheckCovariance(photo, point->covariance_mm2);
    }
    const double reach = photo.upper.empty() ? 0 : Reach(photo);
    if (reach <= 0) Refuse(photo, Reason::kEdgeTooShort, "no upper edge away from the pivot");
    reach_mm += reach;
  }
  FitData data;
  data.length_mm = reach_mm / static_cast<double>(photos.size());
  for (const EdgePoints& photo : photos) data.photos.push_back(Prepare(photo, data.length_mm));
  return data;
}

BladeFrame::BladeFrame(const Pose& pose, bool is_upper) {
  const double angle = is_upper ? pose[kUpperAngle] : pose[kLowerAngle];
  turn_ = Eigen::Rotation2Dd(-angle).toRotationMatrix();
  if (!is_upper) turn_.row(1) *= -1;
  shift_ = -turn_ * Eigen::Vector2d(pose[kPivotX], pose[kPivotY]);
  turn_ *= 1 + pose[kScale];
}

Eigen::Vector2d BladeFrame::operator()(const Eigen::Vector2d& point) const {
  return turn_ * point + shift_;
}

EdgeSamples Thinned(const EdgeSamples& edge, int max_points) {
  if (edge.size() <= max_points) return edge;
  EdgeSamples thin;
  thin.inflation = edge.inflation * std::sqrt(static_cast<double>(max_points) / edge.size());
  for (int group = 0; group < max_points; ++group) {
    const int begin = static_cast<int>(static_cast<long long>(group) * edge.size() / max_points);
    const int end = static_cast<int>(static_cast<long long>(group + 1) * edge.size() / max_points);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double information = 0;
    for (int i = begin; i < end; ++i) {
      const double w2 = edge.weights[i] * edge.weights[i];
      sum += w2 * edge.points[i];
      information += w2;
    }
    thin.points.push_back(sum / information);
    thin.weights.push_back(std::sqrt(information));
    thin.indices.push_back(-1);
  }
  return thin;
}

}  // namespace bladecurve
