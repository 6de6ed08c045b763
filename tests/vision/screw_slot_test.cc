// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_slot.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "vision/screw_images.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

HeadSpec RandomHead(std::uint32_t seed) {
  Draws draws(seed);
  HeadSpec head;
  head.seed = seed;
  const double radius = draws.Uniform(10, 45);
  head.side_px = 4 * static_cast<int>(radius) + 21;
  head.center_px =
      Vector2d::Constant(head.side_px / 2.0) + Vector2d(draws.Uniform(-1, 1), draws.Uniform(-1, 1));
  head.semi_major_px = head.semi_minor_px = radius;
  head.disc = draws.Uniform(-0.1, 0.1);
  head.slot_angle_rad = draws.Uniform(0, std::numbers::pi);
  head.brushed = 0.05;
  head.brushed_angle_rad = draws.Uniform(0, std::numbers::pi);
  return head;
}

// Looked for from where a rim led astray might put the centre.
std::optional<ScrewSlot> FindAside(const HeadSpec& head) {
  Draws draws(head.seed + 1000);
  const double off = 0.1 * head.semi_major_px;
  const Vector2d guess =
      head.center_px + off * Vector2d(draws.Uniform(-1, 1), draws.Uniform(-1, 1));
  return FindSlot(RenderHead(head), SrgbToneCurve(), guess, 1.05 * head.semi_major_px);
}

TEST(FindSlot, SaysWhereTheCentreIs) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    HeadSpec head = RandomHead(seed);
    head.slot = -0.2;
    head.slot_width = Draws(seed).Uniform(0.08, 0.14);
    const std::optional<ScrewSlot> slot = FindAside(head);
    ASSERT_TRUE(slot) << seed;
    const Vector2d error = slot->center_px - head.center_px;
    const Vector2d across(-std::sin(head.slot_angle_rad), std::cos(head.slot_angle_rad));
    EXPECT_LT(std::abs(error.dot(across)), 0.04 * head.semi_major_px) << seed;
    constexpr double kThreeSigma = 11.8;  // chi-square of two coordinates
    EXPECT_LT(error.dot(slot->covariance_px2.inverse() * error), kThreeSigma) << seed;
  }
}

TEST(FindSlot, KnowsTheCentreBetterAcrossTheSlotThanAlongIt) {
  HeadSpec head = RandomHead(7);
  head.slot = -0.2;
  head.slot_width = 0.14;
  head.slot_angle_rad = 0;
  const std::optional<ScrewSlot> slot = FindAside(head);
  ASSERT_TRUE(slot);
  EXPECT_LT(2 * slot->covariance_px2(1, 1), slot->covariance_px2(0, 0));
}

// One wall in the dark is all that is seen of many slots; it lies aside of their middle.
TEST(FindSlot, DoubtsTheMiddleOfWhatIsNarrowerThanSlotsAre) {
  HeadSpec head = RandomHead(7);
  head.slot = -0.2;
  head.slot_angle_rad = 0;
  const auto across_sigma = [&head](double half_width) {
    head.slot_width = half_width;
    const std::optional<ScrewSlot> slot = FindAside(head);
    return slot ? std::sqrt(slot->covariance_px2(1, 1)) / head.semi_major_px : 0;
  };
  EXPECT_GT(across_sigma(0.05), 0.06);
  EXPECT_LT(across_sigma(0.14), 0.04);
}

TEST(FindSlot, DoubtsEndsAboutAnotherCentreThanTheRims) {
  HeadSpec head = RandomHead(7);
  head.slot = -0.2;
  head.slot_width = 0.1;
  head.slot_angle_rad = 0;
  const double off = 0.15 * head.semi_major_px;
  const std::optional<ScrewSlot> slot = FindSlot(
      RenderHead(head), SrgbToneCurve(), head.center_px + Vector2d(off, 0), head.semi_major_px);
  ASSERT_TRUE(slot);
  EXPECT_GT(std::sqrt(slot->covariance_px2(0, 0)), 0.7 * off);
}

TEST(FindSlot, TakesNoStreakOfBrushedMetalForOne) {
  for (std::uint32_t seed = 1; seed <= 120; ++seed) {
    HeadSpec head = RandomHead(seed);
    if (seed % 3 == 1) head.groove = -0.2;
    if (seed % 3 == 2) head.groove = 0.3;
    if (seed > 60) head.semi_major_px = head.semi_minor_px = 6.5;
    EXPECT_FALSE(FindAside(head)) << seed;
  }
}

TEST(FindSlot, IsNotSoughtInSpecks) {
  HeadSpec head = RandomHead(3);
  head.semi_major_px = head.semi_minor_px = 5;
  head.slot = -0.2;
  EXPECT_FALSE(FindAside(head));
}

}  // namespace
}  // namespace bladecurve
