// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bladecurve {
namespace {

// Of the poorest third: less is a tip or a corner, round on one side only.
constexpr double kLeastThird = 0.28;
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

}  // namespace

FoundRim WeighRim(const RimSigns& signs, const ScrewSearch& search) {
  constexpr LooksWeights kOfAHead{10, 0.2}, kOfTheRim{20, 0.12};
  constexpr double kLongEnough = 14;  // a longer rim is no more likely a head's
  const RimFit& fit = signs.fit;
  const double radius = signs.judged_radius_px;
  const bool half_lit = search.half_lit;
  FoundRim found{fit};
  found.evidence = kPriorOdds + SupportEvidence(fit, std::min(radius, kLongEnough), half_lit) +
                   SteepestEvidence(signs.steepest, half_lit) +
                   LooksEvidence(fit.rim, signs.contrast, kOfAHead);
  found.preference = SupportEvidence(fit, radius, half_lit) +
                     LooksEvidence(fit.rim, signs.contrast, kOfTheRim) -
                     UnlikeView(fit.rim, search);
  found.one_sided =
      !half_lit && std::max(fit.third_support, signs.steepest.third_share) < kLeastThird;
  return found;
}

}  // namespace bladecurve
