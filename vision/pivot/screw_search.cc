// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/parallel.h"
#include "vision/pivot/screw_candidates.h"
#include "vision/pivot/screw_field.h"
#include "vision/pivot/screw_steepest.h"

namespace bladecurve {
namespace {

constexpr double kLeastSemiAxisPx = 3.5;  // of a head that can be told from a speck
// Of the poorest third: less is a tip or a corner, round on one side only.
constexpr double kLeastThird = 0.28;
// Heads are judged at 14 to 28 px: larger ones show more grain than rim.
constexpr double kJudgedRadiusPx = 14;
// ln of the odds of a head before anything speaks for it. With the weights below it was chosen by
// logistic regression over 580 heads in rendered scenes of two renderers. Anywhere about the joints
// shank edges, grain and shadows reach 3.9 in one scene of twenty, 6 in one of a hundred, 8 in
// none.
constexpr double kPriorOdds = -7;

// The logarithm of the odds against chance of a share of independent places all of which would look
// like a rim's with that probability by chance: the binomial tail exp(-n KL(share || chance))
// (Chernoff), the "number of false alarms" of Desolneux, Moisan and Morel.
double EvidenceOf(double share, double chance, double independent) {
  if (share <= chance) return 0;
  const double s = std::min(share, 0.999);
  return independent * (s * std::log(s / chance) + (1 - s) * std::log((1 - s) / (1 - chance)));
}

// Of the places all round, the share where the poorest third does not count.
double WithoutPoorestThird(double share, double share_of_third) {
  return 1.5 * share - 0.5 * share_of_third;
}

// That profiles all round look alike; of a half-lit rim, where that says more, those of the two
// thirds beside the poorest, which may lie anywhere.
double SupportEvidence(const RimFit& fit, double radius_px, bool half_lit) {
  constexpr double kChance = 0.35;  // after the fit has chosen the best place
  constexpr double kApartPx = 2.5;  // smoothing along the rim
  constexpr double kChoices = 2.5;  // ln of the number of independent places of the poorest third
  const double independent = 2 * std::numbers::pi * radius_px / kApartPx;
  const double whole = EvidenceOf(fit.support, kChance, independent);
  if (!half_lit) return whole;
  const double share = WithoutPoorestThird(fit.support, fit.third_support);
  return std::max(whole, EvidenceOf(share, kChance, independent / 1.5) - kChoices);
}

// That light changes most on one circle.
double SteepestEvidence(const SteepestCircle& steepest, bool half_lit) {
  constexpr double kChance = 0.5;  // after the best circle has been chosen
  constexpr double kIndependent = 30;
  const double share =
      half_lit ? WithoutPoorestThird(steepest.share, steepest.third_share) : steepest.share;
  return EvidenceOf(share, kChance, kIndependent);
}

struct LooksWeights {
  double contrast;
  double usual_elongation;  // spread of ln(a/b)
};

// What else speaks for a rim. Shape: photographs are taken nearly from above. Contrast: how much it
// stands out of its surroundings.
double LooksEvidence(const RimEllipse& rim, double contrast_score, const LooksWeights& weights) {
  constexpr double kMostContrast = 0.85;
  const Eigen::Vector2d axes = rim.SemiAxes();
  const double elongation = std::log(axes[0] / axes[1]) / weights.usual_elongation;
  return weights.contrast * std::min(contrast_score, kMostContrast) - 0.5 * elongation * elongation;
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

// As FindRims returns them.
void PutBestFirst(std::vector<FoundRim>& rims) {
  if (rims.empty()) return;
  const FoundRim most =
      *std::max_element(rims.begin(), rims.end(), [](const FoundRim& a, const FoundRim& b) {
        return a.evidence < b.evidence;
      });
  const auto others = std::stable_partition(rims.begin(), rims.end(), [&](const FoundRim& found) {
    return OfOneHead(most.fit.rim, found.fit.rim);
  });
  const auto is_preferred = [](const FoundRim& a, const FoundRim& b) {
    return a.preference > b.preference;
  };
  std::stable_sort(rims.begin(), others, is_preferred);
  std::stable_sort(others, rims.end(), is_preferred);
  rims.front().evidence = most.evidence;
}

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
        smooth_(Smooth(fine_.grey)) {}

  // In pixels of the picture.
  [[nodiscard]] std::vector<RimCandidate> Candidates() const {
    const OctaveSearch search{(search_.guess_px - coarse_.origin) / coarse_.scale,
                              search_.radius_px / coarse_.scale};
    std::vector<RimCandidate> candidates = FindRimCandidates(field_, search);
    for (RimCandidate& candidate : candidates)
      candidate.rim = candidate.rim.OutOf(coarse_.origin, coarse_.scale);
    return candidates;
  }

  // The rim near a start, and what speaks for it. Both in picture pixels.
  [[nodiscard]] std::optional<FoundRim> Judge(const RimEllipse& start_px) const {
    std::optional<RimFit> fit = FitNear(start_px.Into(fine_.origin, fine_.scale));
    if (!fit) return std::nullopt;
    const SteepestCircle steepest = SteepestNear(fit->rim);
    if (!AreOne(fit->rim, steepest)) {
      const auto again = FitNear(RimEllipse::Circle(steepest.center, steepest.radius_px));
      if (again && AreOne(again->rim, steepest)) fit = again;
    }
    return Rate(*fit, steepest);
  }

  // The rims, the best one polished unless another octave has one so much better that this cannot
  // help. None where the best is round on one side only: a tip, a corner.
  [[nodiscard]] std::vector<FoundRim> Polished(std::vector<FoundRim> rims,
                                               double most_evidence) const {
    constexpr double kPromising = -2;  // evidence from which on a second look may find a head
    constexpr double kMostGain = 15;   // of evidence by polishing
    if (rims.empty()) return {};
    FoundRim best = rims.front();
    if (best.evidence > kPromising && best.evidence > most_evidence - kMostGain) {
      best = Polish(best);
      rims.push_back(best);
    }
    if (best.one_sided) rims.clear();
    return rims;
  }

 private:
  static constexpr double kMargin =
      3.6;  // radii of the smallest head: 2.1 of the largest and its rim

  // Where the grain of plate and ground is measured: at least three radii about.
  static double Surroundings(const ScrewSearch& search, double min_radius_px) {
    return std::max(search.radius_px, 3 * min_radius_px);
  }

  static cv::Mat Smooth(const cv::Mat& grey) {
    constexpr double kBlurPx = 0.8;
    cv::Mat smooth;
    if (!grey.empty()) cv::GaussianBlur(grey, smooth, {}, kBlurPx);
    return smooth;
  }

  // In pixels of the fine window, all of these.
  [[nodiscard]] std::optional<RimFit> FitNear(const RimEllipse& start) const {
    const double radius = start.MeanRadius();
    return FitRim(fine_.grey, start, {std::max(2.5, 0.2 * radius), std::max(1.5, 0.12 * radius)});
  }
  [[nodiscard]] SteepestCircle SteepestNear(const RimEllipse& rim) const {
    return FindSteepest(smooth_, rim.center, rim.MeanRadius());
  }
  static bool AreOne(const RimEllipse& rim, const SteepestCircle& steepest) {
    constexpr double kApart = 0.15;  // of the radius
    return (rim.center - steepest.center).norm() < kApart * steepest.radius_px;
  }

  // What speaks for a rim in pixels of the fine window; so does the steepest circle hereabouts if
  // it is the rim. How well that is fitted says which of several it is, but little of whether it is
  // a head's.
  [[nodiscard]] std::optional<FoundRim> Rate(const RimFit& fit,
                                             const SteepestCircle& hereabouts) const {
    constexpr LooksWeights kOfAHead{10, 0.2}, kOfTheRim{20, 0.12};
    constexpr double kLongEnough = 14;  // a longer rim is no more likely a head's
    FoundRim found{fit};
    found.fit.rim = fit.rim.OutOf(fine_.origin, fine_.scale);
    found.fit.center_covariance *= fine_.scale * fine_.scale;
    const SteepestCircle steepest = AreOne(fit.rim, hereabouts) ? hereabouts : SteepestCircle{};
    const RimEllipse& rim = found.fit.rim;
    if (!Admissible(rim, search_)) return std::nullopt;
    const double contrast = field_.ScoreWithoutTangents(rim.Into(coarse_.origin, coarse_.scale));
    const double radius = fit.rim.MeanRadius();
    const bool half_lit = search_.half_lit;
    found.evidence = kPriorOdds + SupportEvidence(fit, std::min(radius, kLongEnough), half_lit) +
                     SteepestEvidence(steepest, half_lit) + LooksEvidence(rim, contrast, kOfAHead);
    found.preference = SupportEvidence(fit, radius, half_lit) +
                       LooksEvidence(rim, contrast, kOfTheRim) - UnlikeView(rim, search_);
    found.one_sided = !half_lit && std::max(fit.third_support, steepest.third_share) < kLeastThird;
    return found;
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

  ScrewSearch search_;
  ScaledWindow coarse_, fine_;
  RimField field_;
  cv::Mat smooth_;  // fine_
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

using Octaves = std::vector<std::unique_ptr<const Octave>>;

// A place in one of the octaves that may be a rim.
struct Suspect {
  std::size_t octave;
  RimCandidate candidate;
};

// Those of the best score first.
std::vector<Suspect> SuspectsIn(const Octaves& octaves) {
  const auto candidates = ParallelMap(static_cast<int>(octaves.size()), [&](int i) {
    return octaves[static_cast<std::size_t>(i)]->Candidates();
  });
  std::vector<Suspect> suspects;
  for (std::size_t i = 0; i < octaves.size(); ++i) {
    for (const RimCandidate& candidate : candidates[i]) suspects.push_back({i, candidate});
  }
  std::stable_sort(suspects.begin(), suspects.end(), [](const Suspect& a, const Suspect& b) {
    return a.candidate.score > b.candidate.score;
  });
  return suspects;
}

// What is found near the candidates, octave by octave. What scores far less than a head beyond
// doubt is no other rim of it.
std::vector<std::vector<FoundRim>> JudgeAll(const Octaves& octaves) {
  constexpr double kRivalScore = 0.7;  // of the head's
  constexpr std::size_t kAtOnce = 4;   // whatever the number of cores, so that results are the same
  const std::vector<Suspect> suspects = SuspectsIn(octaves);
  std::vector<std::vector<FoundRim>> found(octaves.size());
  double least_score = 0;
  for (std::size_t first = 0; first < suspects.size(); first += kAtOnce) {
    if (suspects[first].candidate.score < least_score) break;
    const std::size_t count = std::min(kAtOnce, suspects.size() - first);
    const auto rims = ParallelMap(static_cast<int>(count), [&](int i) {
      const Suspect& suspect = suspects[first + static_cast<std::size_t>(i)];
      return octaves[suspect.octave]->Judge(suspect.candidate.rim);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [octave, candidate] = suspects[first + i];
      if (!rims[i]) continue;
      found[octave].push_back(*rims[i]);
      if (rims[i]->evidence > kBeyondDoubt)
        least_score = std::max(least_score, kRivalScore * candidate.score);
    }
  }
  return found;
}

}  // namespace

bool OfOneHead(const RimEllipse& a, const RimEllipse& b) {
  constexpr double kSameHead = 0.5;  // of the radius, between the centres
  constexpr double kMostLarger = 1.35;
  const double radius = a.MeanRadius(), ratio = b.MeanRadius() / radius;
  return (a.center - b.center).norm() < kSameHead * radius && ratio < kMostLarger &&
         ratio > 1 / kMostLarger;
}

std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search) {
  const std::vector<double> radii = OctaveRadii(search);
  const Octaves octaves = ParallelMap(static_cast<int>(radii.size()), [&](int i) {
    return std::make_unique<const Octave>(grey, search, radii[static_cast<std::size_t>(i)]);
  });
  std::vector<std::vector<FoundRim>> judged = JudgeAll(octaves);
  double most_evidence = 0;
  for (std::vector<FoundRim>& rims : judged) {
    PutBestFirst(rims);
    if (!rims.empty()) most_evidence = std::max(most_evidence, rims.front().evidence);
  }
  const auto rims = ParallelMap(static_cast<int>(octaves.size()), [&](int i) {
    const auto octave = static_cast<std::size_t>(i);
    return octaves[octave]->Polished(std::move(judged[octave]), most_evidence);
  });
  std::vector<FoundRim> all;
  for (const std::vector<FoundRim>& octave : rims)
    all.insert(all.end(), octave.begin(), octave.end());
  std::erase_if(all, [](const FoundRim& found) { return found.one_sided; });
  PutBestFirst(all);
  return all;
}

}  // namespace bladecurve
