// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "vision/screw_candidates.h"
#include "vision/screw_field.h"
#include "vision/screw_rim.h"

namespace bladecurve {
namespace {

constexpr double kLeastSemiAxisPx = 3.5;  // of a head that can be told from a speck
constexpr double kLeastAxisRatio =
    0.75;  // flatter: half a head cut off by its slot, not a tilted circle
constexpr double kJudgedRadiusPx =
    14;  // heads are judged at 14 to 28 px: larger ones show more grain than rim

struct Found {
  RimFit fit;  // in picture pixels
  double evidence = 0;
};

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("FindScrew: " + what);
}

void Validate(const cv::Mat& grey, const ScrewSearch& search) {
  Require(grey.type() == CV_8UC1 && !grey.empty(), "the picture must be CV_8UC1 and not empty");
  Require(search.guess_px.allFinite(), "guess_px must be finite");
  Require(search.radius_px > 0 && std::isfinite(search.radius_px), "radius_px must be positive");
  Require(search.min_semi_axis_px > 0, "min_semi_axis_px must be positive");
  Require(
      search.max_semi_axis_px >= search.min_semi_axis_px && std::isfinite(search.max_semi_axis_px),
      "max_semi_axis_px must be finite and not below min_semi_axis_px");
}

// How sure one may be that this is a rim, as the natural logarithm of the odds against chance.
// Support: n independent places of the rim, each of which looks like a rim with probability p by
// chance, has the binomial tail exp(-n KL(support || p)) (Chernoff), the "number of false alarms"
// of Desolneux, Moisan and Morel. Shape: photographs are taken nearly from above. Contrast: how
// much the rim stands out of its surroundings.
double Evidence(double support, double radius_judged_px, double axis_ratio, double contrast_score) {
  constexpr double kChance = 0.35;           // of support, after the fit has chosen the best place
  constexpr double kIndependentPx = 2.5;     // smoothing along the rim
  constexpr double kUsualElongation = 0.12;  // spread of ln(a/b): tilts up to 27 degrees
  constexpr double kContrastWeight = 20, kNeutralContrast = 0.6, kMostContrast = 0.85;
  if (support <= kChance) return 0;
  const double s = std::min(support, 0.999);
  const double divergence = s * std::log(s / kChance) + (1 - s) * std::log((1 - s) / (1 - kChance));
  const double places = 2 * std::numbers::pi * radius_judged_px / kIndependentPx;
  const double elongation = std::log(axis_ratio) / kUsualElongation;
  return places * divergence - 0.5 * elongation * elongation +
         kContrastWeight * (std::min(contrast_score, kMostContrast) - kNeutralContrast);
}

bool Admissible(const RimEllipse& rim, const ScrewSearch& search) {
  const Eigen::Vector2d axes = rim.SemiAxes();
  return axes[0] >= kLeastAxisRatio * axes[1] && axes[0] >= kLeastSemiAxisPx &&
         axes[0] >= 0.9 * search.min_semi_axis_px && axes[1] <= 1.1 * search.max_semi_axis_px &&
         (rim.center - search.guess_px).norm() <= 1.1 * search.radius_px + 1;
}

// All admissible rims of one octave of sizes, from min_radius_px up.
std::vector<Found> SearchOctave(const cv::Mat& grey,
                                const ScrewSearch& search,
                                double min_radius_px) {
  const double scale = min_radius_px / kOctaveRadius;
  const double range = search.radius_px / scale;
  const double surroundings = std::max(range, 3 * kOctaveRadius);
  const double margin = 2.5 * kOctaveRadius + 6;
  const ScaledWindow coarse =
      CutWindow(grey, search.guess_px, (surroundings + margin) * scale, scale);
  const Eigen::Vector2d guess = (search.guess_px - coarse.origin) / scale;
  const RimField field(coarse.grey, guess, surroundings, std::numbers::sqrt2 * kOctaveRadius);

  const double fine_scale = std::max(1.0, min_radius_px / kJudgedRadiusPx);
  const ScaledWindow fine = CutWindow(
      grey, search.guess_px, search.radius_px + 3.4 * min_radius_px + 8 * fine_scale, fine_scale);
  std::vector<Found> found;
  for (const RimCandidate& candidate : FindRimCandidates(field, {guess, range})) {
    const RimEllipse start =
        candidate.rim.OutOf(coarse.origin, scale).Into(fine.origin, fine_scale);
    const double radius = start.MeanRadius();
    const RimFitOptions options{std::max(2.5, 0.2 * radius), std::max(2.0, 0.12 * radius)};
    std::optional<RimFit> fit = FitRim(fine.grey, start, options);
    if (!fit) continue;
    const double judged_radius = fit->rim.MeanRadius();
    fit->rim = fit->rim.OutOf(fine.origin, fine_scale);
    fit->center_covariance *= fine_scale * fine_scale;
    if (!Admissible(fit->rim, search)) continue;
    const Eigen::Vector2d axes = fit->rim.SemiAxes();
    const double contrast = field.Score(fit->rim.Into(coarse.origin, scale));
    found.push_back({*fit, Evidence(fit->support, judged_radius, axes[0] / axes[1], contrast)});
  }
  return found;
}

std::optional<Found> FindBest(const cv::Mat& grey, const ScrewSearch& search) {
  std::optional<Found> best;
  const double smallest = std::max(search.min_semi_axis_px, kLeastSemiAxisPx);
  // Octaves overlap, as a rim near the end of one is seen better in the next.
  for (double radius = smallest; radius == smallest || 1.15 * radius < search.max_semi_axis_px;
       radius *= 1.8) {
    for (const Found& found : SearchOctave(grey, search, radius)) {
      if (!best || found.evidence > best->evidence) best = found;
    }
  }
  return best;
}

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

// The rim in linear light at full resolution; as judged where that fit leaves the place found.
RimFit Refine(const cv::Mat& grey, const ToneCurve& tone, const RimFit& judged) {
  const ScaledWindow light = LightAround(grey, tone, judged.rim);
  const double radius = judged.rim.MeanRadius();
  const double half_px = std::clamp(0.35 * radius, 3.0, 6.0);
  const RimFitOptions options{half_px, half_px, true, 400, 8, 0.002, 0};
  std::optional<RimFit> fit = FitRim(light.grey, judged.rim.Into(light.origin, 1), options);
  if (!fit) return judged;
  fit->rim = fit->rim.OutOf(light.origin, 1);
  const Eigen::Vector2d axes = fit->rim.SemiAxes();
  const bool same_rim = (fit->rim.center - judged.rim.center).norm() < 0.1 * radius &&
                        axes[0] >= kLeastAxisRatio * axes[1];
  return same_rim ? *fit : judged;
}

// The scatter along the rim cannot tell that light falling from one side moves all of it: where
// part of the rim looks otherwise than the rest, the centre is less certain than the scatter says.
// A slot takes up to a tenth of the rim without harm.
Eigen::Matrix2d CenterCovariance(const RimFit& fit, double support) {
  constexpr double kSlotShare = 0.1;
  constexpr double kUnevenShift =
      0.15;  // of the radius, for each share of the rim that does not look like the rest
  const double uneven = std::max(0.0, 1 - support - kSlotShare);
  const double shift = kUnevenShift * uneven * fit.rim.MeanRadius();
  return fit.center_covariance + shift * shift * Eigen::Matrix2d::Identity();
}

}  // namespace

std::optional<Screw> FindScrew(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const ScrewSearch& search) {
  Validate(grey, search);
  const std::optional<Found> best = FindBest(grey, search);
  if (!best || best->evidence < search.least_evidence) return std::nullopt;
  const RimFit fit = Refine(grey, tone, best->fit);
  Screw screw;
  screw.center_px = fit.rim.center;
  screw.covariance_px2 = CenterCovariance(fit, best->fit.support);
  screw.semi_major_px = fit.rim.SemiAxes()[1];
  screw.semi_minor_px = fit.rim.SemiAxes()[0];
  screw.angle_rad = fit.rim.MajorAngle();
  screw.support = best->fit.support;
  screw.evidence = best->evidence;
  return screw;
}

}  // namespace bladecurve
