// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "simulated_edges.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace bladecurve {
namespace {

// A point of the true upper edge in the scissors' frame, and the direction of the edge there.
struct TruePoint {
  Eigen::Vector2d point, along;
};

TruePoint EdgeAt(const BladeCurve& curve, double x_mm, double theta_rad) {
  const CurveSample s = curve.Eval(x_mm, theta_rad);
  return {{x_mm, s.phi_mm}, Eigen::Vector2d(1, s.phi_x).normalized()};
}

// x of the material point at distance u along the chord: the same piece of steel at every angle.
double PlaceOf(const BladeCurve& curve, double u_mm, double theta_rad) {
  if (std::holds_alternative<TaperedRectangle>(curve.shape())) {
    return u_mm * std::cos(theta_rad / 2);
  }
  // x = u cos - s sin, s from the closed blade.
  const double s = curve.Eval(u_mm, 0).phi_mm;
  return u_mm * std::cos(theta_rad / 2) - s * std::sin(theta_rad / 2);
}

// Gaussian noise of unit variance, a running mean over `width` neighbours.
std::vector<double> CorrelatedNoise(int points, int width, Noise& noise) {
  std::vector<double> white(points + width - 1), mean(points);
  for (double& w : white) w = noise.Gaussian();
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < width; ++k) mean[i] += white[i + k] / std::sqrt(width);
  }
  return mean;
}

// One photograph in the making: errors that all its points share.
struct Exposure {
  const SimulatedPhoto& photo;
  Noise& noise;
  double shrink, offset;

  // From the scissors' frame to the frame of the EdgePoints, with the photograph's error of scale.
  [[nodiscard]] Eigen::Vector2d Seen(const Eigen::Vector2d& point) const {
    return photo.pivot_mm + Eigen::Rotation2Dd(photo.axis_rad) * (point / shrink);
  }
  [[nodiscard]] Eigen::Vector2d SeenDirection(const Eigen::Vector2d& direction) const {
    return Eigen::Rotation2Dd(photo.axis_rad) * direction;
  }
};

std::vector<EdgePoint> SeenEdge(const TrueScissors& scissors, const Exposure& e, double side) {
  const BladeCurve curve = TrueCurve(scissors);
  const SimulatedPhoto& photo = e.photo;
  const double step = (scissors.u_end_mm - scissors.u_first_mm) / (photo.points - 1);
  const int width = std::max(1, static_cast<int>(std::lround(photo.correlation_length_mm / step)));
  const std::vector<double> errors = CorrelatedNoise(photo.points, width, e.noise);
  std::vector<EdgePoint> edge;
  for (int i = 0; i < photo.points; ++i) {
    const double u = scissors.u_first_mm + i * step;
    if (u > photo.seen_end_mm) break;
    const TruePoint t = EdgeAt(curve, PlaceOf(curve, u, photo.theta_rad), photo.theta_rad);
    const Eigen::Vector2d point(t.point.x(), side * t.point.y());
    const Eigen::Vector2d normal(side * t.along.y() * side, -side * t.along.x());
    const double off = e.offset + photo.noise_scale * photo.sigma_mm * errors[i];
    edge.push_back({e.Seen(point + off * normal), e.SeenDirection(normal), photo.sigma_mm});
  }
  return edge;
}

LocatedPoint SeenEnd(const TrueScissors& scissors, const Exposure& e, double side) {
  const BladeCurve curve = TrueCurve(scissors);
  const SimulatedPhoto& photo = e.photo;
  const double x = PlaceOf(curve, scissors.u_end_mm, photo.theta_rad);
  const TruePoint t = EdgeAt(curve, x, photo.theta_rad);
  const Eigen::Vector2d along = e.SeenDirection({t.along.x(), side * t.along.y()});
  const Eigen::Vector2d across(-along.y(), along.x());
  LocatedPoint end;
  end.covariance_mm2 =
      photo.end_along_sigma_mm * photo.end_along_sigma_mm * along * along.transpose() +
      photo.sigma_mm * photo.sigma_mm * across * across.transpose();
  const double off_along = photo.end_along_sigma_mm * e.noise.Gaussian();
  const double off_across = photo.sigma_mm * e.noise.Gaussian();
  end.point_mm = e.Seen({t.point.x(), side * t.point.y()}) +
                 photo.noise_scale * (off_along * along + off_across * across);
  end.point_mm -= side * e.offset * across;
  return end;
}

// Along and across the symmetry line.
Eigen::Matrix2d PivotCovariance(const SimulatedPhoto& photo) {
  const double along = photo.pivot_along_sigma_mm.value_or(photo.pivot_sigma_mm);
  const Eigen::Rotation2Dd turn(photo.axis_rad);
  const Eigen::Vector2d variances(along * along, photo.pivot_sigma_mm * photo.pivot_sigma_mm);
  return turn * variances.asDiagonal() * turn.inverse();
}

}  // namespace

double Noise::Uniform() { return (random_() + 0.5) / 4294967296.0; }

double Noise::Gaussian() {
  const double radius = std::sqrt(-2 * std::log(Uniform()));
  return radius * std::cos(2 * std::numbers::pi * Uniform());
}

Eigen::Vector2d Noise::Gaussian(const Eigen::Matrix2d& covariance) {
  const double first = Gaussian(), second = Gaussian();
  return Eigen::LLT<Eigen::Matrix2d>(covariance).matrixL() * Eigen::Vector2d(first, second);
}

EdgePoints Photograph(const TrueScissors& scissors, const SimulatedPhoto& photo, Noise& noise) {
  const double k = photo.noise_scale;
  const Exposure e{photo,
                   noise,
                   1 + k * photo.scale_sigma * noise.Gaussian(),
                   k * photo.offset_sigma_mm * noise.Gaussian()};
  EdgePoints edges;
  edges.photo = "simulated";
  edges.upper = SeenEdge(scissors, e, 1);
  if (photo.lower) edges.lower = SeenEdge(scissors, e, -1);
  edges.pivot.covariance_mm2 = PivotCovariance(photo);
  edges.pivot.point_mm = photo.pivot_mm + k * noise.Gaussian(edges.pivot.covariance_mm2);
  edges.upper_end = SeenEnd(scissors, e, 1);
  edges.lower_end = SeenEnd(scissors, e, -1);
  edges.theta_given = photo.theta_given;
  edges.theta_rad = photo.theta_rad + k * photo.theta_sigma_rad * noise.Gaussian();
  edges.theta_sigma_rad = photo.theta_sigma_rad;
  edges.scale_relative_sigma = photo.scale_sigma;
  edges.common_offset_sigma_mm = photo.offset_sigma_mm;
  edges.correlation_length_mm = photo.correlation_length_mm;
  return edges;
}

TrueScissors SplineScissors(int degree, const std::vector<double>& interior_mm) {
  TrueScissors scissors;
  RigidSpline spline;
  spline.degree = degree;
  spline.knots_mm.assign(degree + 1, scissors.u_first_mm);
  spline.knots_mm.insert(spline.knots_mm.end(), interior_mm.begin(), interior_mm.end());
  spline.knots_mm.insert(spline.knots_mm.end(), degree + 1, scissors.u_end_mm);
  const int size = degree + 1 + static_cast<int>(interior_mm.size());
  for (int j = 0; j < size; ++j) {
    // From -6 mm near the crotch to 0 at the end, bent a little this way and that.
    const double t = static_cast<double>(j) / (size - 1);
    spline.coefficients_mm.push_back(-6 * (1 - t) + (j + 1 < size ? 0.8 * std::sin(5 * t) : 0));
  }
  scissors.shape = spline;
  return scissors;
}

TrueScissors CurvedScissors() { return SplineScissors(3, {}); }

TrueScissors StraightScissors() {
  TrueScissors scissors;
  scissors.shape = RigidSpline{1, {12, 12, 60, 60}, {-6, 0}};
  return scissors;
}

TrueScissors TaperedScissors(double gain) {
  // phi = 0 at the end when closed, as the definition of theta = 0 wants: a + b u_end = 0.
  return {TaperedRectangle{-8.4, 0.14, gain}, 12, 60};
}

BladeCurve TrueCurve(const TrueScissors& scissors) {
  return {scissors.shape, {0, 2 * scissors.u_end_mm, 0, 2.9}};
}

}  // namespace bladecurve
