// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/bands.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "curvefit/compare_families.h"

namespace bladecurve {
namespace {

// Displacements in sigma: small enough to be linear, large enough to be no rounding.
constexpr double kStep = 1e-3;

TaperedRectangle Moved(TaperedRectangle shape, const Eigen::VectorXd& by) {
  shape.a_mm += by(0);
  shape.b += by(1);
  if (by.size() > 2) shape.gain += by(2);
  return shape;
}

RigidSpline Moved(RigidSpline shape, const Eigen::VectorXd& by) {
  for (Eigen::Index j = 0; j < by.size(); ++j) {
    shape.coefficients_mm[static_cast<size_t>(j)] += by(j);
  }
  return shape;
}

BladeCurve Moved(const BladeCurve& curve, const Eigen::VectorXd& by) {
  const auto move = [&](const auto& shape) { return BladeShape(Moved(shape, by)); };
  return {std::visit(move, curve.shape()), curve.domain()};
}

}  // namespace

CurveBand::CurveBand(const FamilyFit& fit) : curve_(fit.curve) {
  if (fit.finer) curve_ = BladeCurve(fit.finer->curve, fit.curve.domain());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(fit.finer ? fit.finer->covariance
                                                                       : fit.covariance);
  for (Eigen::Index k = 0; k < eigen.eigenvalues().size(); ++k) {
    const double variance = eigen.eigenvalues()(k);
    if (!(variance > 0)) continue;
    const Eigen::VectorXd by = kStep * std::sqrt(variance) * eigen.eigenvectors().col(k);
    displaced_.push_back({Moved(curve_, by), Moved(curve_, -by)});
  }
}

CurveSigma CurveBand::At(double x_mm, double theta_rad) const {
  double phi = 0, phi_x = 0, phi_theta = 0;
  for (const Displaced& pair : displaced_) {
    const CurveSample plus = pair.plus.Eval(x_mm, theta_rad);
    const CurveSample minus = pair.minus.Eval(x_mm, theta_rad);
    phi += std::pow(plus.phi_mm - minus.phi_mm, 2);
    phi_x += std::pow(plus.phi_x - minus.phi_x, 2);
    phi_theta += std::pow(plus.phi_theta_mm_per_rad - minus.phi_theta_mm_per_rad, 2);
  }
  constexpr double kScale = 2 * kStep;
  return {std::sqrt(phi) / kScale, std::sqrt(phi_x) / kScale, std::sqrt(phi_theta) / kScale};
}

std::optional<double> CurveBand::TorqueAt(double theta_rad) const {
  const std::optional<double> torque = ThinPlateTorque(curve_, theta_rad);
  if (!torque) return std::nullopt;
  double sum = 0;
  for (const Displaced& pair : displaced_) {
    const std::optional<double> plus = ThinPlateTorque(pair.plus, theta_rad);
    const std::optional<double> minus = ThinPlateTorque(pair.minus, theta_rad);
    if (!plus || !minus) return std::nullopt;
    sum += std::pow(*plus - *minus, 2);
  }
  return std::sqrt(sum) / (2 * kStep * *torque);
}

}  // namespace bladecurve
