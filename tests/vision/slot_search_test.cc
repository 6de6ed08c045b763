// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/slot_search.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/screw_images.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A head flush with its joint, seen against the light: only its slot shows.
HeadSpec FlushHead(std::uint32_t seed, double slot = -0.2) {
  Draws draws(seed);
  HeadSpec head;
  head.seed = seed;
  const double radius = draws.Uniform(12, 30);
  head.side_px = 6 * static_cast<int>(radius) + 21;
  head.center_px = Vector2d::Constant(head.side_px / 2.0) +
                   radius * Vector2d(draws.Uniform(-1, 1), draws.Uniform(-1, 1));
  head.semi_major_px = head.semi_minor_px = radius;
  head.slot = slot;
  head.slot_width = 0.12;
  head.slot_angle_rad = draws.Uniform(0, std::numbers::pi);
  return head;
}

ScrewSearch SearchAbout(const cv::Mat& grey, double radius_px) {
  ScrewSearch search;
  search.guess_px = Vector2d(0.5 * grey.cols, 0.5 * grey.rows);
  search.radius_px = 2 * radius_px;
  search.min_semi_axis_px = 0.6 * radius_px;
  search.max_semi_axis_px = 1.6 * radius_px;
  return search;
}

// slot: how much brighter than the head, linear light.
void ExpectFound(double slot) {
  constexpr double kClose = 0.05;  // of the radius
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const HeadSpec head = FlushHead(seed, slot);
    const cv::Mat grey = RenderHead(head);
    const std::vector<Screw> heads =
        FindSlottedHeads(grey, SrgbToneCurve(), SearchAbout(grey, head.semi_major_px));
    ASSERT_FALSE(heads.empty()) << seed;
    for (const Screw& found : heads) {
      EXPECT_LT((found.slot->center_px - head.center_px).norm(), kClose * head.semi_major_px)
          << seed;
      EXPECT_NEAR(found.semi_major_px, head.semi_major_px, 0.2 * head.semi_major_px) << seed;
      EXPECT_EQ(found.slot->bright, slot > 0) << seed;
    }
  }
}

TEST(FindSlottedHeads, FindsTheCentreOfAHeadWhoseRimDoesNotShow) { ExpectFound(-0.2); }

TEST(FindSlottedHeads, FindsItByASlotThatMirrorsTheLight) { ExpectFound(0.3); }

TEST(FindSlottedHeads, TakesNoBrightStreakOfBrushedMetalForASlot) {
  constexpr double kRadiusPx = 20;
  constexpr int kMetal = 235, kStreak = 248;
  cv::Mat grey(160, 160, CV_8UC1, cv::Scalar(kMetal));
  cv::line(grey, {62, 74}, {98, 86}, kStreak, 3);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EXPECT_TRUE(FindSlottedHeads(grey, SrgbToneCurve(), SearchAbout(grey, kRadiusPx)).empty());
}

TEST(FindSlottedHeads, TakesNoLongLineNorASpeckForASlot) {
  constexpr double kRadiusPx = 20;
  cv::Mat grey(160, 160, CV_8UC1, cv::Scalar(120));
  cv::line(grey, {0, 60}, {159, 90}, 60, 4);
  cv::circle(grey, {100, 110}, 5, 60, cv::FILLED);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EXPECT_TRUE(FindSlottedHeads(grey, SrgbToneCurve(), SearchAbout(grey, kRadiusPx)).empty());
}

TEST(FindSlottedHeads, FindsNothingBesideThePicture) {
  const cv::Mat grey(50, 50, CV_8UC1, cv::Scalar(120));
  ScrewSearch search = SearchAbout(grey, 10);
  search.guess_px = {500, 500};
  EXPECT_TRUE(FindSlottedHeads(grey, SrgbToneCurve(), search).empty());
}

}  // namespace
}  // namespace bladecurve
