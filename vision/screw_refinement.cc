// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_refinement.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "vision/screw_field.h"
#include "vision/screw_profiles.h"
#include "vision/screw_search.h"

namespace bladecurve {
namespace {

constexpr double kFarLess = 0.5;  // of the variance; light alone makes it less by a third

// Encoded grey values around the head as light, at full resolution.
ScaledWindow LightAround(const cv::Mat& grey, const ToneCurve& tone, const RimEllipse& rim) {
  ScaledWindow window = CutWindow(grey, rim.center, 1.5 * rim.SemiAxes()[1] + 8, 1);
  for (int row = 0; row < window.grey.rows; ++row) {
    float* values = window.grey.ptr<float>(row);
    for (int column = 0; column < window.grey.cols; ++column) {
      values[column] = tone.linear[static_cast<std::size_t>(values[column])];
    }
  }
  return window;
}

bool FarLessScatter(const RimFit& fit, const RimFit& plain) {
  return fit.center_covariance.trace() < kFarLess * plain.center_covariance.trace();
}

double AxisRatio(const RimEllipse& rim) {
  const Eigen::Vector2d axes = rim.SemiAxes();
  return axes[0] / axes[1];
}

// Where part of the rim is something else, a fit that lets the light bend follows that as well: its
// scatter is less too, but its ellipse is longer.
bool AsRound(const RimEllipse& rim, const RimEllipse& plain) {
  constexpr double kScatter = 0.005;  // of the axes' ratio
  return AxisRatio(rim) > AxisRatio(plain) - kScatter;
}

// A rim that light or other edges distort scatters alike whatever its grain, or has its centre
// moved by which places count; there the plain fit, to which all count alike, errs less.
bool SameCenter(const RimFit& in_grain, const RimFit& plain) {
  constexpr double kSame = 5.99;  // chi^2 of two coordinates, 95 %
  const Eigen::Vector2d apart = in_grain.rim.center - plain.rim.center;
  return apart.dot(plain.center_covariance.inverse() * apart) < kSame;
}

}  // namespace

RimFit RefineRim(const cv::Mat& grey, const ToneCurve& tone, const RimFit& judged) {
  const ScaledWindow light = LightAround(grey, tone, judged.rim);
  const RimEllipse start = judged.rim.Into(light.origin, 1);
  const double radius = start.MeanRadius();
  const double half_px = std::clamp(0.35 * radius, 3.0, 6.0);
  RimFitOptions options{.first_half_px = half_px, .last_half_px = half_px, .flat_window = true};
  options.most_profiles = 400;
  options.iterations = 8;
  options.converged_px = 0.002;
  options.hopeless_support = 0;
  options.expected_flattening = 0.02;  // as a view 11 degrees off the axis
  std::optional<RimFit> fit = FitRim(light.grey, start, options);
  if (!fit) return judged;
  const RimFit plain = *fit;
  for (int degree = 1; degree <= kMostShading && options.shading == 0; ++degree) {
    RimFitOptions shaded_options = options;
    shaded_options.shading = degree;
    const std::optional<RimFit> shaded = FitRim(light.grey, start, shaded_options);
    if (!shaded || !FarLessScatter(*shaded, plain) || !AsRound(shaded->rim, plain.rim)) continue;
    fit = shaded;
    options = shaded_options;
  }
  options.grain = true;
  options.iterations = 4;  // it starts where the other ended
  const std::optional<RimFit> in_grain = FitRim(light.grey, fit->rim, options);
  if (in_grain && FarLessScatter(*in_grain, *fit) && SameCenter(*in_grain, *fit)) fit = in_grain;
  fit->rim = fit->rim.OutOf(light.origin, 1);
  const bool same_rim = (fit->rim.center - judged.rim.center).norm() < 0.1 * radius &&
                        AxisRatio(fit->rim) >= kLeastAxisRatio;
  return same_rim ? *fit : judged;
}

}  // namespace bladecurve
