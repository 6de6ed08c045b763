// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "vision/image/covariance.h"
#include "vision/parallel.h"
#include "vision/pivot/screw_crescents.h"
#include "vision/pivot/screw_evidence.h"
#include "vision/pivot/screw_field.h"
#include "vision/pivot/screw_ground.h"
#include "vision/pivot/screw_profiles.h"

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
  options.most_profiles = 200;  // 1 px apart at 32 px of radius; nearer, they are alike by the blur
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
  options.converged_px = 0.02;
  return options;
}

// What light from one side does to the centre of fits of each degree, px for each unit of
// RimFit::one_sided; over rendered heads of 10 to 60 px, as far as they did not lose the rim.
constexpr double kDrawnAsidePx[kMostShading + 1] = {3, 1, 0.3};

// -ln of the odds that a fit holds, but for a constant: by the scatter along the rim and what light
// from one side does to it, and by how far from round its ellipse is. Where one side follows
// something else than the rim, the ellipse is longer.
double Doubt(const RefinedRim& rim, const View& view) {
  constexpr double kMost = 6;  // a view may be more oblique
  const double sigmas = (1 - rim.fit.rim.AxisRatioFromAbove(view)) / kUsualFlattening;
  const double drawn_px = kDrawnAsidePx[rim.options.shading] * rim.fit.one_sided;
  return std::log(Scatter(rim.fit) + 2 * drawn_px * drawn_px) +
         std::min(0.5 * sigmas * sigmas, kMost);
}

constexpr double kLeastShadedPx = 10;  // in smaller heads too little lies within the rim

// Light falls from one side, more than grain makes believe (that does the less the longer the rim),
// or has led the fit astray so far that a third of the rim no longer looks like the rest.
bool LitFromOneSide(const RimFit& fit) {
  constexpr double kGrainPx = 0.3, kLeast = 0.015;
  constexpr double kLeastThird = 0.75;  // small heads look that uneven by noise
  const double radius = fit.rim.MeanRadius();
  return fit.one_sided > kLeast + kGrainPx / radius ||
         (radius > kLeastShadedPx && fit.third_support < kLeastThird);
}

std::optional<RefinedRim> Fit(const cv::Mat& light, const RimEllipse& start, int degree) {
  const double radius = start.MeanRadius();
  const RimFitOptions options = degree > 0 ? ShadedOptions(radius, degree) : PlainOptions(radius);
  const std::optional<RimFit> fit = FitRim(light, start, options);
  if (!fit || !SameRim(fit->rim, start)) return std::nullopt;
  return RefinedRim{options, *fit};
}

// The fit with no shading, and where light falls from one side, as that fit says for all, also
// those by degrees; those that ran away are left out.
std::vector<RefinedRim> FitByDegrees(const cv::Mat& light, const RimEllipse& start) {
  const std::optional<RefinedRim> plain = Fit(light, start, 0);
  std::vector<RefinedRim> kept;
  if (plain) kept.push_back(*plain);
  if (start.MeanRadius() < kLeastShadedPx || (plain && !LitFromOneSide(plain->fit))) return kept;
  const auto shaded = ParallelMap(kMostShading, [&](int i) { return Fit(light, start, i + 1); });
  for (const std::optional<RefinedRim>& rim : shaded) {
    if (!rim) continue;
    kept.push_back(*rim);
    kept.back().fit.one_sided = kept.front().fit.one_sided;
  }
  return kept;
}

// Of a fit that starts where this one ended.
RimFitOptions OnwardsFrom(const RefinedRim& refined) {
  RimFitOptions options = refined.options;
  options.iterations = 3;
  return options;
}

// The least doubtful.
std::optional<RefinedRim> FitLight(const cv::Mat& light,
                                   const RimEllipse& start,
                                   const View& view) {
  std::optional<RefinedRim> best;
  double least_doubt = std::numeric_limits<double>::infinity();
  for (const RefinedRim& rim : FitByDegrees(light, start)) {
    const double doubt = Doubt(rim, view);
    if (doubt > least_doubt) continue;
    best = rim;
    least_doubt = doubt;
  }
  return best;
}

// Whether the scatter along the rim is less and the centre no other. A rim that light or other
// edges distort scatters alike whatever its grain, or has its centre moved by which places count;
// there the plain fit, to which all count alike, errs less.
bool Gains(const RimFit& in_grain, const RimFit& plain) {
  constexpr double kLess = 0.8;   // of the variance
  constexpr double kSame = 5.99;  // chi^2 of two coordinates, 95 %
  const Eigen::Vector2d apart = in_grain.rim.center - plain.rim.center;
  return Scatter(in_grain) < kLess * Scatter(plain) &&
         ChiSquare(apart, plain.center_covariance) < kSame;
}

// Makes the ground about the head even and fits there anew; the light as it was if that fails, or
// moves the head by more than any ground does: then it is so faint that little holds it. Of a head
// lit from one side the rim has not the same blur all round, and what is taken for uneven ground is
// partly its own.
cv::Mat EvenOut(const cv::Mat& light, RefinedRim& refined) {
  constexpr double kMost = 0.015, kMostPx = 0.2;  // of the radius; in small heads
  cv::Mat even = WithEvenGround(light, refined.fit.rim);
  std::optional<RimFit> fit = FitRim(even, refined.fit.rim, OnwardsFrom(refined));
  if (!fit) return light;
  const double moved_px = (fit->rim.center - refined.fit.rim.center).norm();
  if (moved_px > std::max(kMost * refined.fit.rim.MeanRadius(), kMostPx)) return light;
  fit->one_sided = refined.fit.one_sided;
  refined.fit = *fit;
  return even;
}

// The fit in the grain of the metal if that gains.
std::optional<RimFit> FitInGrain(const cv::Mat& light, const RefinedRim& refined) {
  RimFitOptions options = OnwardsFrom(refined);
  options.grain = true;
  const std::optional<RimFit> in_grain = FitRim(light, refined.fit.rim, options);
  if (!in_grain || !Gains(*in_grain, refined.fit)) return std::nullopt;
  return in_grain;
}

// Where a third of the rim does not look like the rest, the fit may follow something else there,
// such as the inner border of a lit chamfer. The fit without that third if it says so.
std::optional<RimFit> LeaveOutOddThird(const cv::Mat& light,
                                       const RimEllipse& start,
                                       const RefinedRim& refined) {
  constexpr double kOdd = 0.65;  // support of the third; grain and slots leave more
  constexpr double kApart = 2;   // sigmas of the fit without it
  const RimFit& fit = refined.fit;
  if (fit.rim.MeanRadius() < kLeastShadedPx || fit.third_support > kOdd) return std::nullopt;
  RimFitOptions options = OnwardsFrom(refined);
  options.first_half_px = options.last_half_px;
  options.left_out_rad = fit.odd_third_rad;
  const std::optional<RimFit> without = FitRim(light, fit.rim, options);
  if (!without || !SameRim(without->rim, start)) return std::nullopt;
  const double apart_px2 = (without->rim.center - fit.rim.center).squaredNorm();
  if (apart_px2 < kApart * kApart * Scatter(*without)) return std::nullopt;
  return without;
}

// The scatter along the rim cannot tell that all of it is moved: where part of it looks otherwise
// than the rest, the centre is less certain than the scatter says. A slot takes up to a tenth of
// the rim without harm.
double UnevenVariance(const RimFit& judged, double radius) {
  constexpr double kSlotShare = 0.1;
  constexpr double kUnevenShift = 0.15;  // of the radius, for each share of the rim
  const double shift = kUnevenShift * radius * std::max(0.0, 1 - judged.support - kSlotShare);
  return shift * shift;
}

// Where all of a third of the rim hardly looked like the rest from the start, what was followed may
// be the border of a reflection within the head. Over photoreal heads of 11 to 54 px such fits are
// off by a tenth of the radius.
double ReflectionVariance(const RimFit& judged, double radius) {
  constexpr double kSure = 0.6, kShift = 0.6, kMost = 0.1;  // support; of the radius
  const double shift = radius * std::clamp(kShift * (kSure - judged.third_support), 0.0, kMost);
  return shift * shift;
}

// What the scatter along the rim cannot tell: px^2 of one coordinate.
double UnseenVariance(const RefinedRim& refined, const RimFit& judged) {
  const double radius = refined.fit.rim.MeanRadius();
  const double reflected_px2 = ReflectionVariance(judged, radius);
  if (!LitFromOneSide(refined.fit)) return reflected_px2 + UnevenVariance(judged, radius);
  // The border of a lit chamfer, followed where the rim does not look like the rest, draws the
  // centre by about a pixel; a chamfer that is not resolved does also where all looks alike. Both
  // chosen to hold 95 % of rendered heads of 10 to 60 px whatever the lamp.
  constexpr double kFollowedPx = 0.8, kUnresolvedPx2 = 3;
  const double followed_px = kFollowedPx * (1 - refined.fit.third_support);
  const double unresolved_px = kUnresolvedPx2 / radius;
  return reflected_px2 + followed_px * followed_px + unresolved_px * unresolved_px;
}

RimFit MoreDoubtful(RimFit fit, double variance_px2) {
  fit.center_covariance += variance_px2 * Eigen::Matrix2d::Identity();
  return fit;
}

}  // namespace

RimFit RefineRim(const cv::Mat& grey,
                 const ToneCurve& tone,
                 const RimFit& judged,
                 const std::optional<Eigen::Matrix2d>& view) {
  const ScaledWindow light = LightAround(grey, tone, judged.rim);
  const RimEllipse start = judged.rim.Into(light.origin, 1);
  std::optional<RefinedRim> refined = FitLight(light.grey, start, view);
  if (!refined) return MoreDoubtful(judged, UnevenVariance(judged, judged.rim.MeanRadius()));
  const cv::Mat even = LitFromOneSide(refined->fit) ? light.grey : EvenOut(light.grey, *refined);
  const auto instead = ParallelMap(2, [&](int i) {
    return i == 0 ? LeaveOutOddThird(even, start, *refined) : FitInGrain(even, *refined);
  });
  RimFit fit = LeaveCrescents(light.grey, instead[0].value_or(instead[1].value_or(refined->fit)));
  fit.rim = fit.rim.OutOf(light.origin, 1);
  return MoreDoubtful(fit, UnseenVariance(*refined, judged));
}

}  // namespace bladecurve
