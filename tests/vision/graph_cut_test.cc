// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/graph_cut.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

const cv::Size kSize(400, 300);
const PointedAt kCross{{200, 150}, 24};

// Two bars that cross; one goes on out of the picture.
cv::Mat Bars() {
  cv::Mat mask = cv::Mat::zeros(kSize, CV_8UC1);
  cv::line(mask, {90, 90}, {310, 210}, 255, 29);
  cv::line(mask, {90, 205}, {420, 60}, 255, 29);
  return mask;
}

// With a lens's blur and noise.
cv::Mat Photographed(const cv::Mat& picture) {
  constexpr double kBlur = 0.8, kNoise = 4;  // px, grey values
  cv::Mat photographed, noise(picture.size(), CV_16SC3);
  cv::GaussianBlur(picture, photographed, {}, kBlur);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, kNoise);
  cv::add(photographed, noise, photographed, cv::noArray(), CV_8U);
  return photographed;
}

// Grey, on stripes that are darker and brighter than that.
cv::Mat BarsOnStripes() {
  constexpr int kStripePx = 30;
  cv::Mat picture(kSize, CV_8UC3, cv::Scalar(40, 60, 110));
  for (int y = 0; y < kSize.height; y += 2 * kStripePx)
    picture.rowRange(y, y + kStripePx) = cv::Scalar(150, 215, 235);
  picture.setTo(cv::Scalar::all(140), Bars());
  return Photographed(picture);
}

double Agreement(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

TEST(CutOut, TakesWhatLiesAboutAPlaceOutOfAPatternUpToThePicturesBorder) {
  const cv::Mat mask = CutOut(BarsOnStripes(), kCross);
  EXPECT_GT(Agreement(mask, Bars()), 0.93);
  EXPECT_NE(cv::countNonZero(mask.col(kSize.width - 1)), 0);
  EXPECT_EQ(cv::countNonZero(mask.col(0)), 0);
}

// The cheapest outline rounds off its corners, and would let it end short of the border.
TEST(CutOut, FollowsALimbOutOfThePictureInItsWholeWidth) {
  constexpr int kGround = 100, kThing = 180;
  for (const int width_px : {7, 13}) {
    cv::Mat picture(kSize, CV_8UC3, cv::Scalar::all(kGround));
    cv::line(picture, {270, 300}, {390, -60}, cv::Scalar::all(kThing), width_px);
    cv::line(picture, {90, 120}, {310, 190}, cv::Scalar::all(kThing), 29);
    const cv::Mat mask = CutOut(Photographed(picture), PointedAt{{320, 150}, 24});
    EXPECT_GE(cv::countNonZero(mask.row(0)), width_px);
  }
}

TEST(CutOut, TakesPicturesOfAnyShapeAndColour) {
  for (const cv::Size& size : {cv::Size(640, 17), cv::Size(640, 1), cv::Size(9, 300)}) {
    for (const bool noisy : {false, true}) {
      cv::Mat picture(size, CV_8UC3, cv::Scalar::all(128));
      if (noisy) cv::RNG(1).fill(picture, cv::RNG::UNIFORM, 0, 256);
      for (const cv::Point& place : {cv::Point(0, 0), cv::Point(size.width - 1, size.height - 1)})
        EXPECT_EQ(CutOut(picture, PointedAt{place, 10}).size(), size);
    }
  }
}

TEST(CutOut, GivesTheSameMaskOfTheSamePicture) {
  const cv::Mat picture = BarsOnStripes();
  const cv::Mat mask = CutOut(picture, kCross);
  cv::theRNG().uniform(0, 1);
  EXPECT_EQ(cv::countNonZero(mask != CutOut(picture, kCross)), 0);
}

}  // namespace
}  // namespace bladecurve
