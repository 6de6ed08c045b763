// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace bladecurve {
namespace {

constexpr double kStep = 0.3;  // of a standard error, for differences

BladeShape WithParameter(BladeShape shape, std::size_t index, double change) {
  if (auto* tapered = std::get_if<TaperedRectangle>(&shape)) {
    *std::array{&tapered->a_mm, &tapered->b, &tapered->gain}[index] += change;
  } else {
    std::get<RigidSpline>(shape).coefficients_mm[index] += change;
  }
  return shape;
}

}  // namespace

std::vector<double> PropagateBladeUncertainty(
    const BladeFile& blade, const std::function<std::vector<double>(const BladeCurve&)>& function) {
  const std::vector<double> here = function(blade.curve);
  const std::size_t n = blade.covariance.empty() ? 0 : ParameterValues(blade.curve.shape()).size();
  std::vector<std::vector<double>> slopes(n, std::vector<double>(here.size(), 0));
  for (std::size_t i = 0; i < n; ++i) {
    const double step = kStep * std::sqrt(blade.covariance[i * n + i]);
    if (!(step > 0)) continue;
    const BladeCurve changed(WithParameter(blade.curve.shape(), i, step), blade.curve.domain());
    const std::vector<double> there = function(changed);
    for (std::size_t q = 0; q < here.size(); ++q) slopes[i][q] = (there[q] - here[q]) / step;
  }
  std::vector<double> sigmas(here.size(), 0);
  for (std::size_t q = 0; q < here.size(); ++q) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double covariance = blade.covariance[i * n + j];
        if (!std::isnan(covariance)) sigmas[q] += slopes[i][q] * covariance * slopes[j][q];
      }
    }
    sigmas[q] = std::sqrt(std::max(sigmas[q], 0.0));
  }
  return sigmas;
}

bool KnowsBladeUncertainty(const BladeFile& blade) {
  const std::size_t n = ParameterValues(blade.curve.shape()).size();
  if (blade.covariance.size() != n * n) return false;
  const bool is_tapered = std::holds_alternative<TaperedRectangle>(blade.curve.shape());
  for (std::size_t i = 0; i < (is_tapered ? n - 1 : n); ++i) {
    if (std::isnan(blade.covariance[i * n + i])) return false;
  }
  return true;
}

}  // namespace bladecurve
