// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_rim.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "vision/image/robust_statistics.h"
#include "vision/pivot/screw_grain.h"
#include "vision/pivot/screw_profiles.h"
#include "vision/pivot/screw_shifts.h"

namespace bladecurve {
namespace {

constexpr double kSettledPx = 0.05;  // a smaller change: from here on all profiles are taken
constexpr double kShrink = 0.8;      // of the profiles from one iteration to the next
// Shifts further off are something else than the rim. Where the scatter is known place by place,
// clean rims need not lose their larger errors.
constexpr double kOutlierSigmas = 4, kOutlierSigmasInGrain = 6;
constexpr double kRimCorrelation = 0.6;    // profiles more alike count as rim seen
constexpr double kRimLeastStrength = 0.1;  // of the median: fainter is noise that happens to fit
// How near to the ellipse a rim point must be, of the radius and at least.
constexpr double kRimRelativeWidth = 0.06, kRimLeastWidthPx = 0.5;
// Semi-axes over the radius begun with; beyond, the fit ran away to something else.
constexpr double kLeastOfStart = 0.5, kMostOfStart = 1.6;

// Of profile i, as SampleProfiles numbers them.
double AngleOf(double i, std::size_t count) {
  return 2 * std::numbers::pi * i / static_cast<double>(count);
}

void RateSupport(const std::vector<RimMatch>& matches,
                 const RimUpdate& update,
                 double radius,
                 RimFit& fit) {
  const double width = std::max(kRimRelativeWidth * radius, kRimLeastWidthPx);
  const std::size_t count = matches.size(), third = count / 3;
  std::vector<int> seen(count);
  std::vector<double> strengths(count);
  for (std::size_t i = 0; i < count; ++i) strengths[i] = std::abs(matches[i].strength);
  const double faint = kRimLeastStrength * Median(strengths);
  for (std::size_t i = 0; i < count; ++i) {
    seen[i] = matches[i].correlation > kRimCorrelation && matches[i].strength > faint &&
              std::abs(update.residual_px[static_cast<Eigen::Index>(i)]) < width;
  }
  int in_third =
      std::accumulate(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(third), 0);
  int least = in_third;
  std::size_t least_from = 0;
  for (std::size_t i = 0; i < count; ++i) {
    in_third += seen[(i + third) % count] - seen[i];
    if (in_third >= least) continue;
    least = in_third;
    least_from = i + 1;
  }
  fit.support = std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(count);
  fit.third_support = static_cast<double>(least) / static_cast<double>(third);
  fit.odd_third_rad =
      AngleOf(static_cast<double>(least_from) + 0.5 * static_cast<double>(third), count);
}

double OneSided(const RimProfiles& profiles) {
  constexpr double kClearPx = 1.25;  // of the rim's blur
  const auto taps = static_cast<Eigen::Index>((profiles.t.array() <= -kClearPx).count());
  const Eigen::VectorXd inside = profiles.values.leftCols(taps).rowwise().mean();
  const Eigen::Vector2d harmonic = profiles.jacobian.leftCols<2>().transpose() * inside;
  return 2 * harmonic.norm() / (inside.sum() + 1e-12);
}

// A third of the rim loses its say.
void LeaveOut(double middle_rad, std::vector<RimMatch>& matches) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double apart = AngleOf(static_cast<double>(i), matches.size()) - middle_rad;
    if (std::cos(apart) > 0.5) matches[i].precision = 0;
  }
}

RimEllipse Changed(const RimEllipse& rim, const Vector5d& change) {
  RimEllipse result = rim;
  result.center += change.head<2>();
  result.shape(0, 0) += change[2];
  result.shape(0, 1) += change[3];
  result.shape(1, 0) += change[3];
  result.shape(1, 1) += change[4];
  return result;
}

}  // namespace

std::optional<RimFit> FitRim(const cv::Mat& picture,
                             const RimEllipse& start,
                             const RimFitOptions& options) {
  const double start_radius = start.MeanRadius();
  RimFit fit{start, Eigen::Matrix2d::Identity()};
  RimProfiles profiles;
  double half_px = options.first_half_px;
  bool settling = true;  // half the profiles will do
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    settling = settling && iteration < options.iterations / 2;
    profiles =
        SampleProfiles(picture,
                       fit.rim,
                       {half_px, options.most_profiles / (settling ? 2 : 1), options.flat_window});
    std::optional<RimMatches> matches = MatchProfiles(profiles, options.shading);
    if (!matches) return std::nullopt;
    const bool in_grain = options.grain && !settling;
    if (in_grain) MatchInGrain(profiles, *matches);
    if (options.left_out_rad) LeaveOut(*options.left_out_rad, matches->each);
    RimUpdate update = FitShifts(profiles,
                                 matches->each,
                                 fit.rim,
                                 {in_grain ? kOutlierSigmasInGrain : kOutlierSigmas,
                                  options.expected_flattening * start_radius});
    const double most_change = half_px / 2;  // what lies further off has not been seen
    const double change = update.change.head<2>().norm();
    if (change > most_change) update.change *= most_change / change;
    fit.rim = Changed(fit.rim, update.change);
    const Eigen::Vector2d axes = fit.rim.SemiAxes();
    if (!(axes[0] > kLeastOfStart * start_radius && axes[1] < kMostOfStart * start_radius)) {
      return std::nullopt;
    }
    fit.center_covariance = update.center_covariance;
    if (!settling) RateSupport(matches->each, update, start_radius, fit);
    if (!settling && fit.support < options.hopeless_support) return std::nullopt;
    const bool narrowed = half_px <= options.last_half_px;
    const double last_change = update.change.norm();
    if (!settling && narrowed && last_change < options.converged_px) break;
    settling = settling && !(narrowed && last_change < kSettledPx);
    half_px = std::max(options.last_half_px, kShrink * half_px);
  }
  fit.one_sided = OneSided(profiles);
  return fit;
}

}  // namespace bladecurve
