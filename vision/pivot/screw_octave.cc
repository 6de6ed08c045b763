// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_octave.h"

#include <algorithm>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/parallel.h"
#include "vision/pivot/screw_rim.h"

namespace bladecurve {
namespace {

// How far windows reach beyond the centres sought, in radii of the smallest head: 2.1 of the
// largest and its rim.
constexpr double kMargin = 3.6;

bool Admissible(const RimEllipse& rim, const ScrewSearch& search) {
  const Eigen::Vector2d axes = rim.SemiAxes();
  return axes[0] >= kLeastAxisRatio * axes[1] && axes[0] >= kLeastSemiAxisPx &&
         axes[0] >= 0.9 * search.min_semi_axis_px && axes[1] <= 1.1 * search.max_semi_axis_px &&
         (rim.center - search.guess_px).norm() <= 1.1 * search.radius_px + 1;
}

// The least of an octave, in the window where rims are looked for.
double LeastRadius(const ScrewSearch& search) {
  return search.fine_rims ? 2 * kOctaveRadius : kOctaveRadius;
}

// Where the grain of plate and ground is measured: at least three radii about.
double Surroundings(const ScrewSearch& search, double min_radius_px) {
  return std::max(search.radius_px, 3 * min_radius_px);
}

// Picture pixels per pixel of the window in which heads are judged.
double JudgedScale(const ScrewSearch& search, double min_radius_px) {
  constexpr double kMagnified = 0.5;
  return std::max(search.magnified ? kMagnified : 1, min_radius_px / kJudgedRadiusPx);
}

cv::Mat Smooth(const cv::Mat& grey) {
  constexpr double kBlurPx = 0.8;
  cv::Mat smooth;
  if (!grey.empty()) cv::GaussianBlur(grey, smooth, {}, kBlurPx);
  return smooth;
}

bool AreOne(const RimEllipse& rim, const SteepestCircle& steepest) {
  constexpr double kApart = 0.15;  // of the radius
  return (rim.center - steepest.center).norm() < kApart * steepest.radius_px;
}

}  // namespace

Octave::Octave(const cv::Mat& grey, const ScrewSearch& search, double min_radius_px)
    : search_(search),
      coarse_(CutWindow(grey,
                        search.guess_px,
                        Surroundings(search, min_radius_px) + kMargin * min_radius_px,
                        min_radius_px / LeastRadius(search))),
      fine_(CutWindow(grey,
                      search.guess_px,
                      search.radius_px + kMargin * min_radius_px,
                      JudgedScale(search, min_radius_px))),
      field_(coarse_.grey,
             (search.guess_px - coarse_.origin) / coarse_.scale,
             Surroundings(search, min_radius_px) / coarse_.scale,
             std::numbers::sqrt2 * LeastRadius(search)),
      smooth_(Smooth(fine_.grey)) {}

std::vector<RimCandidate> Octave::Candidates() const {
  const OctaveSearch search{(search_.guess_px - coarse_.origin) / coarse_.scale,
                            search_.radius_px / coarse_.scale,
                            LeastRadius(search_)};
  std::vector<RimCandidate> candidates = FindRimCandidates(field_, search);
  for (RimCandidate& candidate : candidates)
    candidate.rim = candidate.rim.OutOf(coarse_.origin, coarse_.scale);
  return candidates;
}

std::optional<FoundRim> Octave::Judge(const RimEllipse& start_px) const {
  std::optional<RimFit> fit = FitNear(start_px.Into(fine_.origin, fine_.scale));
  if (!fit) return std::nullopt;
  const SteepestCircle steepest = SteepestNear(fit->rim);
  if (!AreOne(fit->rim, steepest)) {
    const auto again = FitNear(RimEllipse::Circle(steepest.center, steepest.radius_px));
    if (again && AreOne(again->rim, steepest)) fit = again;
  }
  return Rate(*fit, steepest);
}

std::optional<RimFit> Octave::FitNear(const RimEllipse& start) const {
  const double radius = start.MeanRadius();
  return FitRim(fine_.grey, start, {std::max(2.5, 0.2 * radius), std::max(1.5, 0.12 * radius)});
}

SteepestCircle Octave::SteepestNear(const RimEllipse& rim) const {
  return FindSteepest(smooth_, rim.center, rim.MeanRadius());
}

std::optional<FoundRim> Octave::Rate(const RimFit& fit, const SteepestCircle& hereabouts) const {
  RimFit fit_px = fit;
  fit_px.rim = fit.rim.OutOf(fine_.origin, fine_.scale);
  fit_px.center_covariance *= fine_.scale * fine_.scale;
  const RimEllipse& rim = fit_px.rim;
  if (!Admissible(rim, search_)) return std::nullopt;
  const double contrast = field_.ScoreWithoutTangents(rim.Into(coarse_.origin, coarse_.scale));
  const SteepestCircle steepest = AreOne(fit.rim, hereabouts) ? hereabouts : SteepestCircle{};
  return WeighRim({fit_px, fit.rim.MeanRadius(), contrast, steepest}, search_);
}

FoundRim Octave::Polish(const FoundRim& found) const {
  constexpr double kAside = 0.15, kLarger = 1.12;  // of the radius: as far as the profiles reach
  const double radius = found.fit.rim.MeanRadius();
  const Eigen::Vector2d& center = found.fit.rim.center;
  std::vector<RimEllipse> starts;
  for (const Eigen::Vector2d& aside : {Eigen::Vector2d(kAside, 0),
                                       Eigen::Vector2d(-kAside, 0),
                                       Eigen::Vector2d(0, kAside),
                                       Eigen::Vector2d(0, -kAside)}) {
    starts.push_back(RimEllipse::Circle(center + radius * aside, radius));
  }
  for (const double factor : {kLarger, 1 / kLarger})
    starts.push_back(RimEllipse::Circle(center, factor * radius));
  const SteepestCircle steepest = SteepestNear(found.fit.rim.Into(fine_.origin, fine_.scale));
  const auto judged =
      ParallelMap(static_cast<int>(starts.size()), [&](int i) -> std::optional<FoundRim> {
        const RimEllipse& start = starts[static_cast<std::size_t>(i)];
        const std::optional<RimFit> fit = FitNear(start.Into(fine_.origin, fine_.scale));
        if (!fit) return std::nullopt;
        return Rate(*fit, steepest);
      });
  FoundRim best = found;
  for (const std::optional<FoundRim>& rim : judged) {
    const bool one_sided = rim && rim->one_sided && !found.one_sided;
    if (rim && !one_sided && rim->preference > best.preference) best = *rim;
  }
  return best;
}

}  // namespace bladecurve
