// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_grain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "vision/screw_images.h"

namespace bladecurve {
namespace {

constexpr int kProfiles = 240, kTaps = 25;
constexpr double kTapPx = 0.5;

double StepAt(double distance_px) { return 0.5 * std::erfc(distance_px / std::numbers::sqrt2); }

// Profiles over a step from 1 to 0, blur 1 px; noise_of(turn) is their standard deviation.
RimProfiles NoisySteps(const std::function<double(double)>& noise_of) {
  Draws draws(7);
  RimProfiles profiles;
  profiles.values.resize(kProfiles, kTaps);
  profiles.t = Eigen::VectorXd::LinSpaced(kTaps, -6, 6);
  profiles.window = Eigen::VectorXd::Ones(kTaps);
  for (int i = 0; i < kProfiles; ++i) {
    const double noise = noise_of(static_cast<double>(i) / kProfiles);
    for (int k = 0; k < kTaps; ++k)
      profiles.values(i, k) = StepAt(profiles.t[k]) + noise * draws.Normal();
  }
  return profiles;
}

RimMatches Matched(const RimProfiles& profiles) {
  std::optional<RimMatches> matches = MatchProfiles(profiles);
  EXPECT_TRUE(matches);
  MatchInGrain(profiles, *matches);
  return *matches;
}

double MeanPrecision(const RimMatches& matches, double from_turn, double to_turn) {
  const int from = static_cast<int>(from_turn * kProfiles),
            to = static_cast<int>(to_turn * kProfiles);
  double sum = 0;
  for (int i = from; i < to; ++i) sum += matches.each[static_cast<std::size_t>(i)].precision;
  return sum / (to - from);
}

// Two opposite quarters five times as noisy, 25 times less precise. A noise that leans by a third
// on the mean of all, 13 times the quiet one, leaves of that (2/3 25 + 13/3) / (2/3 + 13/3) = 4 at
// least, less a third for the scatter of the estimate.
TEST(MatchInGrain, PrecisionFollowsTheNoiseOfThePlace) {
  const RimProfiles profiles =
      NoisySteps([](double turn) { return std::fmod(turn, 0.5) < 0.25 ? 0.01 : 0.05; });
  const RimMatches matches = Matched(profiles);
  const double quiet = MeanPrecision(matches, 0.08, 0.17);
  EXPECT_GT(quiet / MeanPrecision(matches, 0.33, 0.42), 2.7);
  EXPECT_NEAR(MeanPrecision(matches, 0.58, 0.67) / quiet, 1, 0.5);
}

// Noise that neighbours share is no smaller in their mean; such that they do not share is.
TEST(MatchInGrain, SharedNoiseCountsForMoreThanItsSize) {
  RimProfiles profiles = NoisySteps([](double) { return 0.02; });
  for (int i = kProfiles / 4; i < kProfiles / 2; ++i) {
    const int shared = i - i % 20;
    profiles.values.row(i) = profiles.values.row(shared);
    profiles.values.row(i + kProfiles / 2) = profiles.values.row(shared + kProfiles / 2);
  }
  const RimMatches matches = Matched(profiles);
  EXPECT_GT(MeanPrecision(matches, 0.08, 0.17) / MeanPrecision(matches, 0.33, 0.42), 3);
}

// A slot doubles the step; at its own place, with its own level, that is no shift.
TEST(MatchInGrain, LevelOfASlotDoesNotMoveTheRim) {
  constexpr double kNoise = 0.002;
  // Of one profile's shift: noise over the root of the sum of squared slopes, 0.28 / kTapPx.
  const double sigma_px = kNoise / std::sqrt(0.28 / kTapPx);
  RimProfiles profiles = NoisySteps([](double) { return kNoise; });
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < kTaps; ++k) profiles.values(i, k) += StepAt(profiles.t[k]);
  }
  const RimMatches matches = Matched(profiles);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_LT(std::abs(matches.each[i].shift_px), 6 * sigma_px) << "profile " << i;
}

TEST(MatchInGrain, PerfectProfilesStayAsTheyAre) {
  const RimMatches matches = Matched(NoisySteps([](double) { return 0.0; }));
  for (const RimMatch& match : matches.each) {
    EXPECT_NEAR(match.shift_px, 0, 1e-6);
    EXPECT_NEAR(match.precision, 1, 1e-6);
    EXPECT_NEAR(match.spread_px, 1, 1e-6);
  }
}

}  // namespace
}  // namespace bladecurve
