// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/lab_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace bladecurve {
namespace {

constexpr double kClose = 0.01;   // at the levels of the table
constexpr double kBetween = 0.2;  // between them

cv::Vec3f LabOf(const cv::Vec3b& bgr) {
  return LabFromBgr(cv::Mat(1, 1, CV_8UC3, cv::Scalar(bgr))).at<cv::Vec3f>(0, 0);
}

void ExpectLab(const cv::Vec3b& bgr, double lightness, double a, double b, double close) {
  const cv::Vec3f lab = LabOf(bgr);
  EXPECT_NEAR(lab[0], lightness, close) << bgr;
  EXPECT_NEAR(lab[1], a, close) << bgr;
  EXPECT_NEAR(lab[2], b, close) << bgr;
}

// The primaries of sRGB as the literature gives them for D65.
TEST(LabFromBgr, KnowsThePrimaries) {
  ExpectLab({0, 0, 255}, 53.241, 80.092, 67.203, kClose);
  ExpectLab({0, 255, 0}, 87.735, -86.183, 83.179, kClose);
  ExpectLab({255, 0, 0}, 32.297, 79.188, -107.860, kClose);
}

// IEC 61966-2-1 decodes 119 to 0.18448.
TEST(LabFromBgr, GreysHaveNoColour) {
  ExpectLab({255, 255, 255}, 100, 0, 0, kClose);
  ExpectLab({0, 0, 0}, 0, 0, 0, kClose);
  ExpectLab({119, 119, 119}, 116 * std::cbrt(0.18448) - 16, 0, 0, kBetween);
  ExpectLab({5, 5, 5}, 24389.0 / 27 * 5 / 255 / 12.92, 0, 0, kBetween);
}

TEST(LabFromBgr, IsWhatOpenCvGives) {
  constexpr double kSame = 0.02;
  cv::Mat bgr(200, 300, CV_8UC3);
  cv::randu(bgr, 0, 256);
  cv::Mat shares, expected;
  bgr.convertTo(shares, CV_32FC3, 1.0 / 255);
  cv::cvtColor(shares, expected, cv::COLOR_BGR2Lab);
  EXPECT_LT(cv::norm(LabFromBgr(bgr), expected, cv::NORM_INF), kSame);
}

TEST(LabFromBgr, GoesThroughPartsOfPictures) {
  cv::Mat whole(40, 30, CV_8UC3, cv::Scalar::all(0));
  cv::Mat part = whole(cv::Rect(3, 5, 20, 30));
  part.setTo(cv::Scalar(0, 0, 255));
  const cv::Mat lab = LabFromBgr(part);
  ASSERT_EQ(lab.size(), part.size());
  EXPECT_EQ(cv::norm(lab - cv::Scalar(lab.at<cv::Vec3f>(0, 0)), cv::NORM_INF), 0);
}

TEST(LabFromBgr, RefusesOtherPictures) {
  EXPECT_THROW((void)LabFromBgr(cv::Mat(2, 2, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW((void)LabFromBgr(cv::Mat(2, 2, CV_32FC3)), std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
