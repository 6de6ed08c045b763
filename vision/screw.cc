// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vision/screw_candidates.h"
#include "vision/screw_field.h"
#include "vision/screw_rim.h"

namespace bladecurve {
namespace {

constexpr double kLeastSemiAxisPx = 3.5;  // of a head that can be told from a speck
// Flatter: half a head cut off by its slot, not a tilted circle.
constexpr double kLeastAxisRatio = 0.75;
// Support of the poorest third: less is a tip or a corner, round on one side only.
constexpr double kLeastThird = 0.28;
// Heads are judged at 14 to 28 px: larger ones show more grain than rim.
constexpr double kJudgedRadiusPx = 14;

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
// much the rim stands out of its surroundings; its weight is empirical, chosen on photographs where
// it parts screws (7 and more) from shank edges, grain and lettering (below 5).
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

// The search for heads of one octave of sizes, from min_radius_px up.
class Octave {
 public:
  Octave(const cv::Mat& grey, const ScrewSearch& search, double min_radius_px)
      : search_(search),
        coarse_(CutWindow(grey,
                          search.guess_px,
                          Surroundings(search, min_radius_px) + kMargin * min_radius_px,
                          min_radius_px / kOctaveRadius)),
        fine_(CutWindow(grey,
                        search.guess_px,
                        search.radius_px + kMargin * min_radius_px,
                        std::max(1.0, min_radius_px / kJudgedRadiusPx))),
        field_(coarse_.grey,
               (search.guess_px - coarse_.origin) / coarse_.scale,
               Surroundings(search, min_radius_px) / coarse_.scale,
               std::numbers::sqrt2 * kOctaveRadius) {}

  // All that may be a rim, the best one with all that lies around it.
  [[nodiscard]] std::vector<Found> FindAll() const {
    const OctaveSearch search{(search_.guess_px - coarse_.origin) / coarse_.scale,
                              search_.radius_px / coarse_.scale};
    std::vector<Found> all;
    std::optional<Found> best;
    for (const RimCandidate& candidate : FindRimCandidates(field_, search)) {
      const auto found = Judge(candidate.rim.OutOf(coarse_.origin, coarse_.scale));
      if (found) all.push_back(*found);
      KeepBetter(found, best);
    }
    if (best && best->evidence > kPromising) {
      best = Polish(*best);
      all.push_back(*best);
    }
    // Round on one side only: a tip, a corner.
    if (best && best->fit.third_support < kLeastThird) return {};
    return all;
  }

 private:
  static constexpr double kMargin =
      3.6;  // radii of the smallest head: 2.1 of the largest and its rim
  static constexpr double kPromising = 2;  // evidence that is worth a second look

  // Where the grain of plate and ground is measured: at least three radii about.
  static double Surroundings(const ScrewSearch& search, double min_radius_px) {
    return std::max(search.radius_px, 3 * min_radius_px);
  }

  static void KeepBetter(const std::optional<Found>& found, std::optional<Found>& best) {
    if (found && (!best || found->evidence > best->evidence)) best = found;
  }

  // The rim near a start, and what speaks for it. Both in picture pixels.
  [[nodiscard]] std::optional<Found> Judge(const RimEllipse& start_px) const {
    const RimEllipse start = start_px.Into(fine_.origin, fine_.scale);
    const double radius = start.MeanRadius();
    const RimFitOptions options{std::max(2.5, 0.2 * radius), std::max(1.5, 0.12 * radius)};
    std::optional<RimFit> fit = FitRim(fine_.grey, start, options);
    if (!fit) return std::nullopt;
    const double judged_radius = fit->rim.MeanRadius();
    fit->rim = fit->rim.OutOf(fine_.origin, fine_.scale);
    fit->center_covariance *= fine_.scale * fine_.scale;
    if (!Admissible(fit->rim, search_)) return std::nullopt;
    const Eigen::Vector2d axes = fit->rim.SemiAxes();
    const double contrast =
        field_.ScoreWithoutTangents(fit->rim.Into(coarse_.origin, coarse_.scale));
    return Found{*fit, Evidence(fit->support, judged_radius, axes[0] / axes[1], contrast)};
  }

  // The fit may have stopped at a rim that shares only an arc with the head's: starts on all sides
  // of it decide.
  [[nodiscard]] Found Polish(const Found& found) const {
    constexpr double kAside = 0.15, kLarger = 1.12;  // of the radius: as far as the profiles reach
    const double radius = found.fit.rim.MeanRadius();
    std::optional<Found> best = found;
    for (const Eigen::Vector2d& aside : {Eigen::Vector2d(kAside, 0),
                                         Eigen::Vector2d(-kAside, 0),
                                         Eigen::Vector2d(0, kAside),
                                         Eigen::Vector2d(0, -kAside)}) {
      KeepBetter(Judge(RimEllipse::Circle(found.fit.rim.center + radius * aside, radius)), best);
    }
    for (const double factor : {kLarger, 1 / kLarger}) {
      KeepBetter(Judge(RimEllipse::Circle(found.fit.rim.center, factor * radius)), best);
    }
    return *best;
  }

  ScrewSearch search_;
  ScaledWindow coarse_, fine_;
  RimField field_;
};

// Of all sizes, the best first.
std::vector<Found> FindAll(const cv::Mat& grey, const ScrewSearch& search) {
  std::vector<Found> all;
  const double smallest = std::max(search.min_semi_axis_px, kLeastSemiAxisPx);
  // Octaves overlap, as a rim near the end of one is seen better in the next.
  for (double radius = smallest; radius == smallest || 1.15 * radius < search.max_semi_axis_px;
       radius *= 1.8) {
    const std::vector<Found> found = Octave(grey, search, radius).FindAll();
    all.insert(all.end(), found.begin(), found.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
    return a.evidence > b.evidence;
  });
  std::erase_if(all, [](const Found& found) { return found.fit.third_support < kLeastThird; });
  return all;
}

// Whether both are rims of the same head, but not the same rim.
bool Rivals(const RimEllipse& a, const RimEllipse& b) {
  constexpr double kSameRim = 0.04, kSameHead = 0.5;  // of the radius, between the centres
  constexpr double kMostLarger = 1.35;
  const double radius = a.MeanRadius(), ratio = b.MeanRadius() / radius;
  const double apart = (a.center - b.center).norm() / radius;
  return apart > kSameRim && apart < kSameHead && ratio < kMostLarger && ratio > 1 / kMostLarger;
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
  // A view 11 degrees off the axis flattens a round head by 2 %.
  const RimFitOptions options{half_px, half_px, true, 400, 8, 0.002, 0, 0.02};
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

// The centre where several rims compete for one head (a bevelled edge, a lit recess round it):
// their mean by the odds that their evidence gives them, and how far they part.
struct WeighedCenter {
  Eigen::Vector2d center;
  Eigen::Matrix2d spread;  // px^2
};

WeighedCenter WeighCenters(const cv::Mat& grey,
                           const ToneCurve& tone,
                           const std::vector<Found>& all,
                           const RimFit& best) {
  constexpr double kUnlikely = 3;  // less evidence than the best has: odds of 20 to 1
  std::vector<const Found*> rims{&all.front()};
  std::vector<std::pair<double, Eigen::Vector2d>> centers{{1, best.rim.center}};
  for (const Found& found : all) {
    const double behind = all.front().evidence - found.evidence;
    if (behind > kUnlikely) break;
    const bool differs = std::all_of(rims.begin(), rims.end(), [&](const Found* rim) {
      return Rivals(rim->fit.rim, found.fit.rim);
    });
    if (!differs) continue;
    rims.push_back(&found);
    centers.emplace_back(std::exp(-behind), Refine(grey, tone, found.fit).rim.center);
  }
  double total = 0;
  WeighedCenter weighed{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  for (const auto& [weight, center] : centers) {
    weighed.center += weight * center;
    total += weight;
  }
  weighed.center /= total;
  for (const auto& [weight, center] : centers) {
    const Eigen::Vector2d off = center - weighed.center;
    weighed.spread += weight / total * off * off.transpose();
  }
  return weighed;
}

}  // namespace

std::optional<Screw> FindScrew(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const ScrewSearch& search) {
  Validate(grey, search);
  const cv::Rect2d picture(-0.5, -0.5, grey.cols, grey.rows);
  if (!picture.contains({search.guess_px.x(), search.guess_px.y()})) return std::nullopt;
  const std::vector<Found> all = FindAll(grey, search);
  if (all.empty() || all.front().evidence < search.least_evidence) return std::nullopt;
  const Found& best = all.front();
  const RimFit fit = Refine(grey, tone, best.fit);
  const WeighedCenter weighed = WeighCenters(grey, tone, all, fit);
  Screw screw;
  screw.center_px = weighed.center;
  screw.covariance_px2 = CenterCovariance(fit, best.fit.support) + weighed.spread;
  screw.semi_major_px = fit.rim.SemiAxes()[1];
  screw.semi_minor_px = fit.rim.SemiAxes()[0];
  screw.angle_rad = fit.rim.MajorAngle();
  screw.support = best.fit.support;
  screw.evidence = best.evidence;
  return screw;
}

}  // namespace bladecurve
