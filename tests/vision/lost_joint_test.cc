// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/lost_joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kGround = 50, kMetal = 80;
constexpr int kJointPx = 90;  // from the mask's shank crotch to the joint's end
const cv::Point kHole(300, 160);

// Scissors whose shanks the mask shows so wide, from where a hole in it begins.
cv::Mat MaskWithShanks(int width_px) {
  cv::Mat mask(320, 640, CV_8UC1, cv::Scalar(0));
  for (const int sign : {-1, 1}) {
    const std::vector<cv::Point> blade{
        kHole + cv::Point(300, sign * 70), kHole + cv::Point(0, 20), kHole + cv::Point(0, -20)};
    cv::fillConvexPoly(mask, blade, 255);
    cv::line(mask, kHole, kHole + cv::Point(-200, sign * 70), 255, width_px);
    cv::circle(mask, kHole + cv::Point(-230, sign * 80), 36, 255, 12);
  }
  return mask;
}

// The best of the mask, in a picture with a line of that much more light across the gap between the
// shanks.
Candidate SeenWithLine(const cv::Mat& mask, int contrast) {
  cv::Mat light(mask.size(), CV_8UC1, cv::Scalar(kGround));
  light.setTo(kMetal, mask);
  const int reach = kJointPx / 3;
  cv::line(light,
           kHole + cv::Point(-kJointPx, -reach),
           kHole + cv::Point(-kJointPx, reach),
           kGround + contrast,
           3);
  light.convertTo(light, CV_32FC1);
  Candidate like;
  like.at = std::make_shared<const ScaledImage>(ScaledImage{light, cv::Rect({}, light.size())});
  const Rung rung = SeenIn(mask, like, {}, {});
  return rung.candidates.empty() ? Candidate() : rung.candidates.front();
}

constexpr int kRim = 4, kWhole = 18, kPlain = 25, kFaint = 6;

TEST(EndOfLostJoint, IsWhereALineCrossesTheGapBetweenShanks) {
  constexpr double kClosePx = 5;
  const Candidate found = SeenWithLine(MaskWithShanks(kRim), kPlain);
  ASSERT_GT(found.pair.quality, kAcceptedQuality);
  const auto end = EndOfLostJoint(found);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->x(), kHole.x - kJointPx, kClosePx);
  EXPECT_NEAR(end->y(), kHole.y, kClosePx);
}

TEST(EndOfLostJoint, IsNoneBetweenShanksThatAreWhole) {
  EXPECT_FALSE(EndOfLostJoint(SeenWithLine(MaskWithShanks(kWhole), kPlain)));
}

TEST(EndOfLostJoint, IsNoneWhereTheGapIsLikeTheGround) {
  EXPECT_FALSE(EndOfLostJoint(SeenWithLine(MaskWithShanks(kRim), kFaint)));
  EXPECT_FALSE(EndOfLostJoint(SeenWithLine(MaskWithShanks(kRim), 0)));
}

// Blades that open by so much to the right of their crotch; the shanks' crotch lies to its left.
Candidate PairWithJoint(double half_opening_rad, double width, double joint) {
  constexpr double kLength = 100;
  Candidate found;
  found.at = std::make_shared<const ScaledImage>();
  BladePair& pair = found.pair;
  pair.crotch = {300, 200};
  pair.shank_crotch = pair.crotch - Vector2d(joint, 0);
  const auto tip = [&](double direction) -> Vector2d {
    return pair.crotch + kLength * Vector2d(std::cos(direction), std::sin(direction));
  };
  pair.first.tip = tip(-half_opening_rad);
  pair.second.tip = tip(half_opening_rad);
  pair.first.width = width;
  pair.second.width = 1.5 * width;
  return found;
}

TEST(EndOfLostJoint, IsWhereMembersAsWideAsTheBladesHaveCrossed) {
  for (const double half_opening : {0.1, 0.3, 0.7}) {
    const double crossing = 12 / std::sin(half_opening);
    EXPECT_FALSE(EndOfLostJoint(PairWithJoint(half_opening, 12, 2 * crossing)));
    EXPECT_FALSE(EndOfLostJoint(PairWithJoint(half_opening, 12, 1.4 * crossing)));
    const Candidate lost = PairWithJoint(half_opening, 12, 0.8 * crossing);
    const auto end = EndOfLostJoint(lost);
    ASSERT_TRUE(end) << half_opening;
    EXPECT_GT((*end - lost.pair.crotch).norm(), 1.4 * crossing);
    EXPECT_NEAR(end->y(), lost.pair.crotch.y(), 1e-9);
    EXPECT_LT(end->x(), lost.pair.crotch.x());
  }
}

}  // namespace
}  // namespace bladecurve
