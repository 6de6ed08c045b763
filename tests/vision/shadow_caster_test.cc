// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/shadow_caster.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/scene/moved_image.h"
#include "vision/scene/parted_members.h"
#include "vision/scene/tones.h"

namespace bladecurve {
namespace {

const cv::Size kPictureSize(600, 400);
const cv::Point kShift(14, 9);

// Two members that cross, with rings, moved aside.
cv::Mat Scissors(const cv::Point& aside = {0, 0}) {
  cv::Mat mask = cv::Mat::zeros(kPictureSize, CV_8UC1);
  for (const int side : {-1, 1}) {
    const cv::Point tip = cv::Point(80, 200 + side * 70) + aside;
    const cv::Point ring = cv::Point(480, 200 - side * 90) + aside;
    cv::line(mask, tip, ring, 255, 13);
    cv::circle(mask, ring + cv::Point(30, -side * 15), 36, 255, 9);
  }
  return mask;
}

// As a small picture shows them: blurred and noisy, 0 on the ground.
cv::Mat Seen(double metal, const cv::Mat& other, double tone) {
  cv::Mat lightness = cv::Mat::zeros(kPictureSize, CV_32FC1), noise(kPictureSize, CV_32FC1);
  lightness.setTo(tone, other);
  lightness.setTo(metal, Scissors());
  cv::GaussianBlur(lightness, lightness, {}, 1.2);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, 1);
  return lightness + noise;
}

double Overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

TEST(TonesOf, AreTheLevelsThatAreApart) {
  const cv::Mat shadow = Scissors(kShift);
  const Tones tones = TonesOf(Seen(-60, shadow, -25), Scissors() | shadow);
  ASSERT_EQ(tones.peaks.size(), 2U);
  EXPECT_NEAR(tones.peaks[0], -60, 1.5);
  EXPECT_NEAR(tones.peaks[1], -25, 1.5);
  ASSERT_EQ(tones.valleys.size(), 1U);
  EXPECT_GT(tones.valleys[0], -57);
  EXPECT_LT(tones.valleys[0], -28);
  EXPECT_EQ(TonesOf(Seen(-40, shadow, -32), Scissors() | shadow).peaks.size(), 2U);
  EXPECT_EQ(TonesOf(Seen(-60, shadow, -58), Scissors() | shadow).peaks.size(), 1U);
}

TEST(BestMovedImage, IsTheShadow) {
  const cv::Mat shadow = Scissors(kShift) & ~Scissors();
  const MovedImage image = BestMovedImage(Scissors(), shadow);
  EXPECT_NEAR(image.shift_px[0], kShift.x, 1);
  EXPECT_NEAR(image.shift_px[1], kShift.y, 1);
  EXPECT_GT(image.agreement, 0.99);
  const MovedImage backwards = BestMovedImage(shadow, Scissors());
  EXPECT_LT(backwards.agreement, image.agreement) << "the scissors cover some of it";
}

const cv::Mat kNoneColoured = cv::Mat::zeros(kPictureSize, CV_8UC1);

TEST(MasksOfShadowCaster, AreOfTheMetalWhateverItsTone) {
  const cv::Mat shadow = Scissors(kShift);
  const cv::Mat things = Scissors() | shadow;
  for (const double metal : {-60, -12, 25}) {
    const std::vector<cv::Mat> masks =
        MasksOfShadowCaster(Seen(metal, shadow, -35), things, kNoneColoured);
    ASSERT_EQ(masks.size(), 3U) << metal;
    for (const cv::Mat& mask : masks) EXPECT_GT(Overlap(mask, Scissors()), 0.85) << metal;
  }
}

// Black blades, and handles of the shadow's tone.
TEST(MasksOfShadowCaster, AreOfTheColouredToo) {
  constexpr double kBlade = -45, kShadow = -35;
  const cv::Mat shadow = Scissors(kShift), things = Scissors() | shadow;
  cv::Mat handles = kNoneColoured.clone();
  handles.colRange(300, kPictureSize.width).setTo(255);
  handles &= Scissors();
  cv::Mat lightness = Seen(kBlade, shadow, kShadow);
  lightness.setTo(kShadow, handles);
  EXPECT_TRUE(MasksOfShadowCaster(lightness, things, kNoneColoured).empty());
  const std::vector<cv::Mat> masks = MasksOfShadowCaster(lightness, things, handles);
  ASSERT_EQ(masks.size(), 3U);
  for (const cv::Mat& mask : masks) EXPECT_GT(Overlap(mask, Scissors()), 0.85);
}

TEST(MasksOfShadowCaster, AreNoneWithoutAShadow) {
  constexpr double kMetal = -30;
  const cv::Mat image = Scissors(kShift);
  EXPECT_TRUE(MasksOfShadowCaster(Seen(kMetal, cv::Mat(), 0), Scissors(), kNoneColoured).empty());
  EXPECT_TRUE(MasksOfShadowCaster(Seen(25, image, 60), Scissors() | image, kNoneColoured).empty())
      << "a shadow is darker than the ground";
  cv::Mat bevels = cv::Mat::zeros(kPictureSize, CV_8UC1), metal = Seen(kMetal, cv::Mat(), 0);
  cv::line(bevels, {80, 133}, {280, 200}, 255, 5);
  cv::line(bevels, {80, 267}, {280, 200}, 255, 5);
  metal.setTo(-60, bevels);
  EXPECT_TRUE(MasksOfShadowCaster(metal, Scissors(), kNoneColoured).empty())
      << "dark bevels, on both blades";
}

// The shadow of one blade across the other one.
TEST(JoinPartedMembers, GoesOnWithTheBladeThatAShadowParts) {
  const cv::Mat whole = Scissors();
  const cv::Point shift(-40, -25);
  cv::Mat shadow = cv::Mat::zeros(kPictureSize, CV_8UC1), blade = shadow.clone();
  cv::line(shadow, cv::Point(80, 270) + shift, cv::Point(480, 110) + shift, 255, 13);
  cv::line(blade, {80, 130}, {230, 190}, 255, 13);
  cv::Mat mask = whole.clone();
  mask.setTo(0, shadow & blade);
  ASSERT_LT(cv::countNonZero(mask & blade), 0.9 * cv::countNonZero(blade));
  JoinPartedMembers({shift.x, shift.y}, &mask);
  EXPECT_GT(cv::countNonZero(mask & blade), 0.98 * cv::countNonZero(blade));
  EXPECT_GT(Overlap(mask, whole), 0.97);
}

}  // namespace
}  // namespace bladecurve
