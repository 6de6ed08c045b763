// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_refinement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/screw_field.h"
#include "vision/screw_profiles.h"
#include "vision/screw_search.h"

namespace bladecurve {
namespace {

using View = std::optional<Eigen::Matrix2d>;

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

double Scatter(const RimFit& fit) { return fit.center_covariance.trace(); }

// -2 ln of the odds that a fit holds: by the scatter along the rim, and by how far from round its
// ellipse is. Where one side follows something else than the rim, the ellipse is longer.
double Doubt(const RimFit& fit, const View& view) {
  constexpr double kUsualFlattening = 0.02;  // as a view 11 degrees off the axis
  constexpr double kMost = 6;                // a view may be more oblique
  const double sigmas = (1 - fit.rim.AxisRatioFromAbove(view)) / kUsualFlattening;
  return std::log(Scatter(fit)) + std::min(0.5 * sigmas * sigmas, kMost);
}

// The fit with more freedom for the light takes from what tells the place, so its scatter may only
// be more than the plain fit's where that one has a side that does not look like the rest.
double MostScatter(const RimFit& plain) {
  constexpr double kAlikeAllRound = 0.85;  // support of the poorest third
  constexpr double kMore = 5;
  return (plain.third_support < kAlikeAllRound ? kMore : 1) * Scatter(plain);
}

// The options whose fit is the least doubtful, and that fit: `plain`, or one that lets light rise
// or fall towards the rim within the head.
struct ShadedFit {
  RimFitOptions options;
  RimFit fit;
};

ShadedFit ModelShading(const cv::Mat& light,
                       const RimEllipse& start,
                       const View& view,
                       const ShadedFit& plain) {
  constexpr double kLeastRadiusPx = 10;  // in smaller heads too little lies within the rim
  constexpr double kWithin = 0.22;       // of the radius: light bends more further in
  constexpr double kClearly = 0.5;       // less doubt; less than that is chance
  ShadedFit best = plain;
  const double radius = start.MeanRadius();
  if (radius < kLeastRadiusPx) return best;
  double most_doubt = Doubt(plain.fit, view) - kClearly;
  for (int degree = 1; degree <= kMostShading; ++degree) {
    RimFitOptions options = plain.options;
    options.shading = degree;
    options.last_half_px = std::clamp(kWithin * radius, 3.0, 6.0);
    options.iterations = 12;  // the profiles shorten first
    const std::optional<RimFit> fit = FitRim(light, start, options);
    if (!fit || Doubt(*fit, view) > most_doubt || Scatter(*fit) > MostScatter(plain.fit)) continue;
    most_doubt = Doubt(*fit, view);
    best = {options, *fit};
  }
  return best;
}

// Whether the scatter along the rim is far less and the centre no other. A rim that light or other
// edges distort scatters alike whatever its grain, or has its centre moved by which places count;
// there the plain fit, to which all count alike, errs less.
bool Gains(const RimFit& in_grain, const RimFit& plain) {
  constexpr double kFarLess = 0.5;  // of the variance; light alone makes it less by a third
  constexpr double kSame = 5.99;    // chi^2 of two coordinates, 95 %
  const Eigen::Vector2d apart = in_grain.rim.center - plain.rim.center;
  return Scatter(in_grain) < kFarLess * Scatter(plain) &&
         apart.dot(plain.center_covariance.inverse() * apart) < kSame;
}

}  // namespace

RimFit RefineRim(const cv::Mat& grey,
                 const ToneCurve& tone,
                 const RimFit& judged,
                 const std::optional<Eigen::Matrix2d>& view) {
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
  const std::optional<RimFit> plain = FitRim(light.grey, start, options);
  if (!plain) return judged;
  auto [best_options, fit] = ModelShading(light.grey, start, view, {options, *plain});
  best_options.grain = true;
  best_options.iterations = 4;  // it starts where the other ended
  const std::optional<RimFit> in_grain = FitRim(light.grey, fit.rim, best_options);
  if (in_grain && Gains(*in_grain, fit)) fit = *in_grain;
  fit.rim = fit.rim.OutOf(light.origin, 1);
  const Eigen::Vector2d axes = fit.rim.SemiAxes();
  const bool same_rim = (fit.rim.center - judged.rim.center).norm() < 0.1 * radius &&
                        axes[0] >= kLeastAxisRatio * axes[1];
  return same_rim ? fit : judged;
}

}  // namespace bladecurve
