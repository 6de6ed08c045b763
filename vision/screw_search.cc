// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "vision/parallel.h"
#include "vision/screw_candidates.h"
#include "vision/screw_field.h"

namespace bladecurve {
namespace {

constexpr double kLeastSemiAxisPx = 3.5;  // of a head that can be told from a speck
// Support of the poorest third: less is a tip or a corner, round on one side only.
constexpr double kLeastThird = 0.28;
// Heads are judged at 14 to 28 px: larger ones show more grain than rim.
constexpr double kJudgedRadiusPx = 14;

// The logarithm of the odds against chance of so many places that look like a rim, of which `share`
// do: n independent ones, each of which does with probability p by chance, have the binomial tail
// exp(-n KL(share || p)) (Chernoff), the "number of false alarms" of Desolneux, Moisan and Morel.
double SupportEvidence(double share, double length_px) {
  constexpr double kChance = 0.35;        // after the fit has chosen the best place
  constexpr double kIndependentPx = 2.5;  // smoothing along the rim
  if (share <= kChance) return 0;
  const double s = std::min(share, 0.999);
  const double divergence = s * std::log(s / kChance) + (1 - s) * std::log((1 - s) / (1 - kChance));
  return length_px / kIndependentPx * divergence;
}

// The same of all of a rim; of a half-lit one, where that says more, of the two thirds beside the
// poorest, which may lie anywhere.
double SupportEvidence(const RimFit& fit, double radius_judged_px, bool half_lit) {
  constexpr double kChoices = 2.5;  // ln of the number of independent places of the poorest third
  const double length = 2 * std::numbers::pi * radius_judged_px;
  const double whole = SupportEvidence(fit.support, length);
  if (!half_lit) return whole;
  const double share = 1.5 * fit.support - 0.5 * fit.third_support;
  return std::max(whole, SupportEvidence(share, length / 1.5) - kChoices);
}

// What else speaks for a rim. Shape: photographs are taken nearly from above. Contrast: how much it
// stands out of its surroundings; its weight is empirical, chosen on photographs where it parts
// screws (5 and more with their support) from shank edges, grain and lettering (seldom 4).
double LooksEvidence(const RimEllipse& rim, double contrast_score) {
  constexpr double kUsualElongation = 0.12;  // spread of ln(a/b): tilts up to 27 degrees
  constexpr double kContrastWeight = 20, kNeutralContrast = 0.6, kMostContrast = 0.85;
  const Eigen::Vector2d axes = rim.SemiAxes();
  const double elongation = std::log(axes[0] / axes[1]) / kUsualElongation;
  return kContrastWeight * (std::min(contrast_score, kMostContrast) - kNeutralContrast) -
         0.5 * elongation * elongation;
}

// Of rims of one head, what speaks against this one where the view is known: ln of the odds. A rim
// that is longer than the view explains follows the head on one side and something else on the
// other. No reason to see no head at all, hence bounded.
double UnlikeView(const RimEllipse& rim, const ScrewSearch& search) {
  constexpr double kScatter = 0.03;  // of ln(a/b), the fit's own
  constexpr double kMost = 6;
  if (!search.view) return 0;
  const double sigmas = std::log(rim.AxisRatioFromAbove(search.view)) / kScatter;
  return std::min(0.5 * sigmas * sigmas, kMost);
}

bool Admissible(const RimEllipse& rim, const ScrewSearch& search) {
  const Eigen::Vector2d axes = rim.SemiAxes();
  return axes[0] >= kLeastAxisRatio * axes[1] && axes[0] >= kLeastSemiAxisPx &&
         axes[0] >= 0.9 * search.min_semi_axis_px && axes[1] <= 1.1 * search.max_semi_axis_px &&
         (rim.center - search.guess_px).norm() <= 1.1 * search.radius_px + 1;
}

bool IsOneSided(const FoundRim& found, const ScrewSearch& search) {
  return !search.half_lit && found.fit.third_support < kLeastThird;
}

bool IsPreferred(const FoundRim& a, const FoundRim& b) { return a.Preference() > b.Preference(); }

// All that may be the rim of a head in one octave of sizes, from min_radius_px up.
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
               std::numbers::sqrt2 * kOctaveRadius),
        rims_(FindAll()) {}

  [[nodiscard]] double MostPreference() const {
    return rims_.empty() ? 0 : rims_.front().Preference();
  }

  // The rims, the best one polished unless another octave has one so much better that this cannot
  // help. None where the best is round on one side only: a tip, a corner.
  [[nodiscard]] std::vector<FoundRim> Polished(double most_preference) const {
    constexpr double kPromising = -2;  // evidence from which on a second look may find a head
    constexpr double kMostGain = 15;   // of preference by polishing, in 97 % of heads
    if (rims_.empty()) return {};
    std::vector<FoundRim> rims = rims_;
    FoundRim best = rims.front();
    if (best.evidence > kPromising && best.Preference() > most_preference - kMostGain) {
      best = Polish(best);
      rims.push_back(best);
    }
    if (IsOneSided(best, search_)) rims.clear();
    return rims;
  }

 private:
  static constexpr double kMargin =
      3.6;  // radii of the smallest head: 2.1 of the largest and its rim
  // Of a head's score: what shows less beside a head beyond doubt is no other rim of it.
  static constexpr double kRivalScore = 0.7;

  // Where the grain of plate and ground is measured: at least three radii about.
  static double Surroundings(const ScrewSearch& search, double min_radius_px) {
    return std::max(search.radius_px, 3 * min_radius_px);
  }

  // The best one first.
  [[nodiscard]] std::vector<FoundRim> FindAll() const {
    const OctaveSearch search{(search_.guess_px - coarse_.origin) / coarse_.scale,
                              search_.radius_px / coarse_.scale};
    std::vector<FoundRim> all;
    double least_score = 0;
    for (const RimCandidate& candidate : FindRimCandidates(field_, search)) {
      if (candidate.score < least_score) break;
      const auto found = Judge(candidate.rim.OutOf(coarse_.origin, coarse_.scale));
      if (!found) continue;
      all.push_back(*found);
      if (found->evidence > kBeyondDoubt) least_score = kRivalScore * candidate.score;
    }
    std::stable_sort(all.begin(), all.end(), IsPreferred);
    return all;
  }

  // The rim near a start, and what speaks for it. Both in picture pixels.
  [[nodiscard]] std::optional<FoundRim> Judge(const RimEllipse& start_px) const {
    const RimEllipse start = start_px.Into(fine_.origin, fine_.scale);
    const double radius = start.MeanRadius();
    const RimFitOptions options{std::max(2.5, 0.2 * radius), std::max(1.5, 0.12 * radius)};
    std::optional<RimFit> fit = FitRim(fine_.grey, start, options);
    if (!fit) return std::nullopt;
    const double judged_radius = fit->rim.MeanRadius();
    fit->rim = fit->rim.OutOf(fine_.origin, fine_.scale);
    fit->center_covariance *= fine_.scale * fine_.scale;
    if (!Admissible(fit->rim, search_)) return std::nullopt;
    const double contrast =
        field_.ScoreWithoutTangents(fit->rim.Into(coarse_.origin, coarse_.scale));
    return FoundRim{
        *fit,
        SupportEvidence(*fit, judged_radius, search_.half_lit) + LooksEvidence(fit->rim, contrast),
        UnlikeView(fit->rim, search_)};
  }

  // The fit may have stopped at a rim that shares only an arc with the head's: starts on all sides
  // of it decide.
  [[nodiscard]] FoundRim Polish(const FoundRim& found) const {
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
    const auto judged = ParallelMap(static_cast<int>(starts.size()), [&](int i) {
      return Judge(starts[static_cast<std::size_t>(i)]);
    });
    FoundRim best = found;
    for (const std::optional<FoundRim>& rim : judged) {
      const bool one_sided = rim && IsOneSided(*rim, search_) && !IsOneSided(found, search_);
      if (rim && !one_sided && IsPreferred(*rim, best)) best = *rim;
    }
    return best;
  }

  ScrewSearch search_;
  ScaledWindow coarse_, fine_;
  RimField field_;
  std::vector<FoundRim> rims_;  // the best first
};

// Smallest radius of each octave. They overlap, as a rim near the end of one is seen better in the
// next.
std::vector<double> OctaveRadii(const ScrewSearch& search) {
  constexpr double kApart = 1.8, kLeastLarger = 1.15;
  std::vector<double> radii{std::max(search.min_semi_axis_px, kLeastSemiAxisPx)};
  while (kLeastLarger * kApart * radii.back() < search.max_semi_axis_px)
    radii.push_back(kApart * radii.back());
  return radii;
}

}  // namespace

std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search) {
  const std::vector<double> radii = OctaveRadii(search);
  const auto octaves = ParallelMap(static_cast<int>(radii.size()), [&](int i) {
    return std::make_unique<const Octave>(grey, search, radii[static_cast<std::size_t>(i)]);
  });
  double most_preference = 0;
  for (const auto& octave : octaves)
    most_preference = std::max(most_preference, octave->MostPreference());
  const auto rims = ParallelMap(static_cast<int>(octaves.size()), [&](int i) {
    return octaves[static_cast<std::size_t>(i)]->Polished(most_preference);
  });
  std::vector<FoundRim> all;
  for (const std::vector<FoundRim>& octave : rims)
    all.insert(all.end(), octave.begin(), octave.end());
  std::stable_sort(all.begin(), all.end(), IsPreferred);
  std::erase_if(all, [&](const FoundRim& found) { return IsOneSided(found, search); });
  return all;
}

}  // namespace bladecurve
