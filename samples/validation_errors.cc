// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "curvefit/bands.h"
#include "model/degrees.h"
#include "samples/fitted_photo.h"

namespace bladecurve {
namespace {

struct Foot {
  double distance = 0;  // signed; positive to the left of the line's direction, y down
  bool at_end = false;  // the nearest point is an end of the line
};

Foot FootOn(const std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& p) {
  Foot best{.distance = std::numeric_limits<double>::infinity(), .at_end = true};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d step = line[i + 1] - line[i], from_start = p - line[i];
    const double t = from_start.dot(step) / step.squaredNorm();
    const double distance = (from_start - std::clamp(t, 0.0, 1.0) * step).norm();
    if (distance >= std::abs(best.distance)) continue;
    const double side = step.y() * from_start.x() - step.x() * from_start.y();
    best.distance = std::copysign(distance, side);
    best.at_end = (i == 0 && t < 0) || (i + 2 == line.size() && t > 1);
  }
  return best;
}

// Standard uncertainty of the mean of an edge's points: what they share, and what correlated
// neighbours leave.
double MeanOffsetSigmaPx(const std::vector<EdgePoint>& points, const PhotoMeasurement& photo) {
  double variance_mm2 = 0;
  for (const EdgePoint& point : points) variance_mm2 += point.sigma_mm * point.sigma_mm;
  const double count = static_cast<double>(points.size());
  const double length_mm = (points.back().point_mm - points.front().point_mm).norm();
  const double spacing_mm = length_mm / std::max(count - 1, 1.0);
  const double alike = std::max(1.0, photo.edges.correlation_length_mm / spacing_mm);
  const double own_mm2 = variance_mm2 / count * std::min(1.0, alike / count);
  const double shared_mm = photo.edges.common_offset_sigma_mm;
  return std::sqrt(own_mm2 + shared_mm * shared_mm) / photo.mm_per_px;
}

// An edge in mm with sigmas, and in the photograph.
struct MeasuredEdge {
  const std::vector<EdgePoint>& points;
  const std::vector<Eigen::Vector2d>& px;
};

QuantityErrors EdgeErrors(const MeasuredEdge& edge,
                          const EdgeTruth& truth,
                          const PhotoMeasurement& photo) {
  double sum = 0, squares = 0;
  int count = 0;
  for (const Eigen::Vector2d& p : edge.px) {
    const Foot foot = FootOn(truth.px, p);
    if (foot.at_end) continue;
    sum += foot.distance;
    squares += foot.distance * foot.distance;
    ++count;
  }
  if (count == 0) return {.size = std::numeric_limits<double>::infinity(), .stated = {}};
  return {.size = std::sqrt(squares / count),
          .stated = {{sum / count, MeanOffsetSigmaPx(edge.points, photo)}}};
}

// The pivot's axis stands on the sheet; seen obliquely it is a short line, from the edges' height
// to the screw's head.
QuantityErrors PivotErrors(const FittedPhoto& photo, const SceneTruth& truth) {
  const Eigen::Vector2d axis = truth.screw_px - truth.pivot_px;
  const double t =
      axis.norm() > 0
          ? std::clamp((photo.pivot_px - truth.pivot_px).dot(axis) / axis.squaredNorm(), 0.0, 1.0)
          : 0.0;
  const Eigen::Vector2d error = photo.pivot_px - truth.pivot_px - t * axis;
  return {.size = error.norm(),
          .stated = {{error.x(), photo.pivot_sigma_px}, {error.y(), photo.pivot_sigma_px}}};
}

QuantityErrors ThetaErrors(const FittedPhoto& photo, const SceneTruth& truth) {
  const double error = (photo.theta_rad - truth.theta_rad) * kDegPerRad;
  return {.size = std::abs(error), .stated = {{error, photo.theta_sigma_rad * kDegPerRad}}};
}

// Of a scale that was measured; one that was given is right.
QuantityErrors ScaleErrors(double mm_per_px, double sigma, const SceneTruth& truth) {
  if (truth.markers.empty()) return {};
  const double error = 1e6 * (mm_per_px / truth.mm_per_px - 1);
  return {.size = std::abs(error), .stated = {{error, 1e6 * sigma / truth.mm_per_px}}};
}

RigidSpline SplineOf(const EdgeShape& shape) {
  RigidSpline spline;
  spline.degree = 3;
  spline.knots_mm = {shape.from_mm,
                     shape.from_mm,
                     shape.from_mm,
                     shape.from_mm,
                     shape.to_mm,
                     shape.to_mm,
                     shape.to_mm,
                     shape.to_mm};
  spline.coefficients_mm.assign(shape.bernstein_mm.begin(), shape.bernstein_mm.end());
  return spline;
}

QuantityErrors PhiErrors(const FamilyFit& fit, const BladeCurve& truth, double theta_rad) {
  constexpr int kPlaces = 9;
  const CurveBand band(fit);
  const double from = std::max(fit.curve.domain().x_min_mm, truth.domain().x_min_mm);
  const double to = std::min(fit.curve.domain().x_max_mm, truth.domain().x_max_mm);
  QuantityErrors errors;
  double squares = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double x = from + (to - from) * (i + 0.5) / kPlaces;
    const double error = fit.curve.Eval(x, theta_rad).phi_mm - truth.Eval(x, theta_rad).phi_mm;
    squares += error * error;
    errors.stated.push_back({error, band.At(x, theta_rad).phi_mm});
  }
  errors.size = std::sqrt(squares / kPlaces);
  return errors;
}

// tau_c / (J_c h) = phi_theta / phi_x where the edges touch (delta = 0, h = 0); NaN if they do not.
double SharpTorque(const BladeCurve& curve, double theta_rad) {
  std::array<double, 1> x_mm;
  if (curve.Contacts(0, theta_rad, x_mm) < 1) return std::numeric_limits<double>::quiet_NaN();
  const CurveSample sample = curve.Eval(x_mm[0], theta_rad);
  return sample.phi_theta_mm_per_rad / sample.phi_x;
}

QuantityErrors TorqueErrors(const FamilyFit& fit, const BladeCurve& truth, double theta_rad) {
  constexpr int kAngles = 9;
  const CurveBand band(fit);
  QuantityErrors errors;
  double squares = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = theta_rad * (1.0 / 3 + 2.0 / 3 * (i + 0.5) / kAngles);
    const double percent = 100 * (SharpTorque(fit.curve, angle) / SharpTorque(truth, angle) - 1);
    const std::optional<double> sigma = band.TorqueAt(angle);
    if (!std::isfinite(percent) || !sigma) continue;  // the photograph does not show that contact
    squares += percent * percent;
    errors.stated.push_back({percent, 100 * *sigma});
  }
  if (errors.stated.empty()) return errors;
  errors.size = std::sqrt(squares / static_cast<double>(errors.stated.size()));
  return errors;
}

BladeCurve TrueCurve(const SceneTruth& truth) {
  const auto free = std::find_if(truth.upper.blade_mm.begin(),
                                 truth.upper.blade_mm.end(),
                                 [&](const auto& p) { return p.x() >= truth.upper.free_from_mm; });
  const auto first =
      std::min<std::size_t>(free - truth.upper.blade_mm.begin(), truth.upper.blade_mm.size() - 1);
  const CurveDomain domain{.x_min_mm = truth.upper.scissors_mm[first].x(),
                           .x_max_mm = truth.upper.scissors_mm.back().x(),
                           .theta_min_rad = 0,
                           .theta_max_rad = std::max(truth.theta_rad, 1.0)};
  return {SplineOf(truth.upper.shape), domain};
}

}  // namespace

std::array<QuantityErrors, kQuantities> CompareWithTruth(const Analysis& analysis,
                                                         const SceneTruth& truth) {
  const PhotoMeasurement& photo = analysis.photos.front();
  const FittedPhoto fitted = ApplyPose(photo, analysis.fit.poses.front());
  const FamilyFit& fit = analysis.fit.recommended;
  const BladeCurve true_curve = TrueCurve(truth);
  return {EdgeErrors({photo.edges.upper, photo.upper_edge_px}, truth.upper, photo),
          EdgeErrors({photo.edges.lower, photo.lower_edge_px}, truth.lower, photo),
          PivotErrors(fitted, truth),
          ThetaErrors(fitted, truth),
          ScaleErrors(fitted.mm_per_px, photo.mm_per_px_sigma, truth),
          PhiErrors(fit, true_curve, truth.theta_rad),
          TorqueErrors(fit, true_curve, truth.theta_rad)};
}

}  // namespace bladecurve
