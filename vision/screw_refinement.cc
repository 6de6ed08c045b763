// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_refinement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "vision/parallel.h"
#include "vision/screw_field.h"
#include "vision/screw_profiles.h"
#include "vision/screw_search.h"

namespace bladecurve {
namespace {

using View = std::optional<Eigen::Matrix2d>;

constexpr double kUsualFlattening = 0.02;  // of a head, as a view 11 degrees off the axis

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

// -ln of the odds that a fit holds, but for a constant: by the scatter along the rim, and by how
// far from round its ellipse is. Where one side follows something else than the rim, the ellipse is
// longer.
double Doubt(const RimFit& fit, const View& view) {
  constexpr double kMost = 6;  // a view may be more oblique
  const double sigmas = (1 - fit.rim.AxisRatioFromAbove(view)) / kUsualFlattening;
  return std::log(Scatter(fit)) + std::min(0.5 * sigmas * sigmas, kMost);
}

// Whether the fit did not run away to another rim than it began at.
bool SameRim(const RimEllipse& rim, const RimEllipse& start) {
  constexpr double kOff = 0.1, kLarger = 0.1;  // of the radius
  constexpr double kLargerPx = 2;              // what is judged of small heads is rough
  const double radius = start.MeanRadius();
  const Eigen::Vector2d axes = rim.SemiAxes();
  return (rim.center - start.center).norm() < kOff * radius &&
         std::abs(rim.MeanRadius() - radius) < std::max(kLarger * radius, kLargerPx) &&
         axes[0] >= kLeastAxisRatio * axes[1];
}

struct RefinedRim {
  RimFitOptions options;
  RimFit fit;
};

RimFitOptions PlainOptions(double radius) {
  const double half_px = std::clamp(0.35 * radius, 3.0, 6.0);
  RimFitOptions options{.first_half_px = half_px, .last_half_px = half_px, .flat_window = true};
  options.most_profiles = 400;
  options.iterations = 8;
  options.converged_px = 0.005;
  options.hopeless_support = 0;
  options.expected_flattening = kUsualFlattening;
  return options;
}

// Light may rise or fall towards the rim within the head.
RimFitOptions ShadedOptions(double radius, int degree) {
  constexpr double kWithin = 0.22;  // of the radius: light bends more further in
  RimFitOptions options = PlainOptions(radius);
  options.shading = degree;
  options.last_half_px = std::clamp(kWithin * radius, 3.0, options.first_half_px);
  options.iterations = 12;  // the profiles shorten first
  return options;
}

// A fit with more freedom for the light takes from what tells the place: its scatter may only be
// more than the plain fit's where that one has a side that does not look like the rest.
double MostScatter(const RimFit& plain) {
  constexpr double kAlikeAllRound = 0.85;  // support of the poorest third
  constexpr double kMore = 5;
  return (plain.third_support < kAlikeAllRound ? kMore : 1) * Scatter(plain);
}

// The fit with no shading first, then by degrees; those that ran away are left out.
std::vector<RefinedRim> FitByDegrees(const cv::Mat& light, const RimEllipse& start) {
  constexpr double kLeastRadiusPx = 16;  // in smaller heads too little lies within the rim
  const double radius = start.MeanRadius();
  std::vector<RimFitOptions> options{PlainOptions(radius)};
  for (int degree = 1; radius >= kLeastRadiusPx && degree <= kMostShading; ++degree)
    options.push_back(ShadedOptions(radius, degree));
  const auto fits = ParallelMap(static_cast<int>(options.size()), [&](int i) {
    return FitRim(light, start, options[static_cast<std::size_t>(i)]);
  });
  std::vector<RefinedRim> kept;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i] && SameRim(fits[i]->rim, start)) kept.push_back({options[i], *fits[i]});
  }
  return kept;
}

// The least doubtful; a shaded one instead of the plain one only if that is clearly in doubt.
std::optional<RefinedRim> FitLight(const cv::Mat& light,
                                   const RimEllipse& start,
                                   const View& view) {
  constexpr double kClearly = 0.5;  // less doubt; less than that is chance
  std::optional<RefinedRim> best;
  double most_doubt = std::numeric_limits<double>::infinity(), most_scatter = most_doubt;
  for (const RefinedRim& rim : FitByDegrees(light, start)) {
    const double doubt = Doubt(rim.fit, view);
    if (doubt > most_doubt || Scatter(rim.fit) > most_scatter) continue;
    best = rim;
    most_doubt = doubt;
    if (rim.options.shading > 0) continue;
    most_doubt -= kClearly;
    most_scatter = MostScatter(rim.fit);
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
  std::optional<RefinedRim> refined = FitLight(light.grey, start, view);
  if (!refined) return judged;
  refined->options.grain = true;
  refined->options.iterations = 4;  // it starts where the other ended
  RimFit& fit = refined->fit;
  const std::optional<RimFit> in_grain = FitRim(light.grey, fit.rim, refined->options);
  if (in_grain && Gains(*in_grain, fit)) fit = *in_grain;
  fit.rim = fit.rim.OutOf(light.origin, 1);
  return fit;
}

}  // namespace bladecurve
