// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/curve_sigma.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace bladecurve {
namespace {

// The parameters of a shape in the order of FamilyFit::covariance.
std::vector<double*> ParametersOf(BladeShape* shape) {
  if (auto* tapered = std::get_if<TaperedRectangle>(shape)) {
    return {&tapered->a_mm, &tapered->b, &tapered->gain};
  }
  std::vector<double*> parameters;
  for (double& c : std::get<RigidSpline>(*shape).coefficients_mm) parameters.push_back(&c);
  return parameters;
}

double PhiWith(
    const FamilyFit& fit, std::size_t parameter, double change, double x_mm, double theta_rad) {
  BladeShape shape = fit.curve.shape();
  *ParametersOf(&shape)[parameter] += change;
  return BladeCurve(shape, fit.curve.domain()).Eval(x_mm, theta_rad).phi_mm;
}

}  // namespace

double PhiSigma(const FamilyFit& fit, double x_mm, double theta_rad) {
  BladeShape shape = fit.curve.shape();
  const auto count = std::min<Eigen::Index>(fit.covariance.rows(),
                                            static_cast<Eigen::Index>(ParametersOf(&shape).size()));
  constexpr double kChange =
      1e-5;  // phi is linear in the parameters, or nearly; the sum of rounding and bend is 1e-10
  Eigen::VectorXd gradient(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto parameter = static_cast<std::size_t>(i);
    gradient[i] = (PhiWith(fit, parameter, kChange, x_mm, theta_rad) -
                   PhiWith(fit, parameter, -kChange, x_mm, theta_rad)) /
                  (2 * kChange);
  }
  const double variance = gradient.dot(fit.covariance.topLeftCorner(count, count) * gradient);
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace bladecurve
