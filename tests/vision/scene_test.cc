// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "measured_blades.h"
#include "process_folder.h"
#include "tests/degree.h"
#include "vision/measure.h"
#include "vision/photo/photo.h"
#include "vision/photo/png_writer.h"
#include "vision/refused.h"
#include "vision/render/render.h"
#include "vision/scene/beyond_tips.h"
#include "vision/scene/blades.h"
#include "vision/scene/catches.h"
#include "vision/scene/closed_shape.h"
#include "vision/scene/flood.h"
#include "vision/scene/limb_count.h"
#include "vision/scene/limbs.h"
#include "vision/scene/region_merging.h"
#include "vision/scene/scene_candidate.h"
#include "vision/scene/scene_ladder.h"
#include "vision/scene/sharp_gradient.h"
#include "vision/scene/silhouette.h"
#include "vision/scene/touching_handles.h"
#include "vision/stage_log.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// The reason of a refusal, or "" if the picture is measured.
std::string ReasonFor(const cv::Mat& picture, const SceneHints& hints = {}) {
  const fs::path file = ProcessFolder() / "picture.png";
  WritePng(file, picture);
  MeasureOptions options;
  options.scale.mm_per_px = 0.25;
  options.hints = hints;
  try {
    (void)MeasurePhoto(file, options);
    return "";
  } catch (const Refused& refused) {
    return std::string(ReasonCode(refused.reason()));
  }
}

SceneSpec SmallScene() {
  SceneSpec spec;
  spec.width = 1000;
  spec.height = 750;
  spec.camera.mm_per_px = 0.25;
  return spec;
}

// Lab picture of an even ground with a sharply outlined disc of the same colour on the left, and a
// soft dark cloud on the right.
cv::Mat DiscAndCloud() {
  cv::Mat lightness(200, 400, CV_32FC1, cv::Scalar(60));
  cv::circle(lightness, {300, 100}, 45, cv::Scalar(20), cv::FILLED);
  cv::GaussianBlur(lightness, lightness, {}, 12);
  cv::circle(lightness, {100, 100}, 40, cv::Scalar(40), 3, cv::LINE_AA);
  cv::GaussianBlur(lightness, lightness, {}, 0.7);
  const cv::Mat chroma = cv::Mat::zeros(lightness.size(), CV_32FC1);
  cv::Mat lab;
  cv::merge(std::vector<cv::Mat>{lightness, chroma, chroma}, lab);
  return lab;
}

double MostIn(const cv::Mat& levels, const cv::Rect& part) {
  double most = 0;
  cv::minMaxLoc(levels(part), nullptr, &most);
  return most;
}

const cv::Rect kOutside = {180, 10, 40, 180}, kCloud = {260, 60, 80, 80};  // of that picture

TEST(FloodLevels, WallInWhatIsSharplyOutlinedWhateverItsColour) {
  const cv::Mat lab = DiscAndCloud();
  const cv::Mat ground = GroundAtFrame(cv::Mat::zeros(lab.size(), CV_32FC1));
  const cv::Mat levels = FloodLevels(Walls(SharpGradient(lab), 3, {}), ground);
  const float disc = levels.at<float>(100, 100);
  EXPECT_GT(disc, 10 * MostIn(levels, kOutside));
  EXPECT_LT(MostIn(levels, kCloud), 0.2F * disc);
}

// A grainy picture like it, the disc's outline all but lost over a ninth of its length: a flood
// runs in.
TEST(MergingLevels, KeepApartWhatIsSharplyOutlinedButForAWhile) {
  cv::Mat lab = DiscAndCloud();
  cv::Mat right = lab(cv::Rect(130, 86, 18, 28));
  const cv::Mat even(right.size(), right.type(), cv::Scalar(60, 0, 0));
  cv::addWeighted(right, 0.1, even, 0.9, 0, right);
  cv::Mat grain(lab.size(), lab.type());
  cv::RNG(1).fill(grain, cv::RNG::NORMAL, 0, 0.5);
  const cv::Mat walls = Walls(SharpGradient(lab + grain), 5, {});
  const cv::Mat ground = GroundAtFrame(cv::Mat::zeros(lab.size(), CV_32FC1));
  const cv::Mat flooded = FloodLevels(walls, ground);
  EXPECT_LT(flooded.at<float>(100, 90), MostIn(flooded, kOutside));
  const cv::Mat merged = MergingLevels(walls, ground);
  const float disc = merged.at<float>(100, 90);
  EXPECT_GT(disc, 3 * MostIn(merged, kOutside));
  EXPECT_GT(disc, 3 * MostIn(merged, kCloud));
}

TEST(Walls, AreNoneWhereNothingIsToBeLookedAt) {
  const cv::Mat lab = DiscAndCloud();
  cv::Mat ignore = cv::Mat::zeros(lab.size(), CV_8UC1);
  ignore(cv::Rect(50, 50, 100, 100)).setTo(255);
  const cv::Mat sharp_gradient = SharpGradient(lab);
  const cv::Rect disc(55, 55, 90, 90);
  EXPECT_GT(MostIn(Walls(sharp_gradient, 3, {}), disc), 0);
  EXPECT_EQ(MostIn(Walls(sharp_gradient, 3, ignore), disc), 0);
}

// A rod with two rings at its left end; `gap_px` parts it from the right end on.
cv::Mat RodWithRings(int gap_px) {
  cv::Mat mask = cv::Mat::zeros(300, 600, CV_8UC1);
  const std::vector<cv::Point> rod{{120, 138}, {560, 146}, {560, 154}, {120, 162}};
  cv::fillConvexPoly(mask, rod, 255);
  for (const int y : {115, 185}) cv::circle(mask, {90, y}, 38, 255, 10);
  if (gap_px > 0) {
    const std::vector<cv::Point> gap{{300, 150}, {561, 150 - gap_px}, {561, 150 + gap_px}};
    cv::fillConvexPoly(mask, gap, 0);
  }
  return mask;
}

TEST(LooksClosed, IsARodWithRings) {
  const cv::Mat mask = RodWithRings(0);
  EXPECT_TRUE(LooksClosed(FindSilhouettes(mask, 1).front()));
  cv::Mat turned;
  cv::rotate(mask, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  EXPECT_TRUE(LooksClosed(FindSilhouettes(turned, 1).front()));
}

TEST(LooksClosed, IsNotARodThatParts) {
  cv::Mat mask = cv::Mat::zeros(300, 600, CV_8UC1);
  for (const int sign : {-1, 1}) {
    const std::vector<cv::Point> blade{
        {290, 150 - 12 * sign}, {560, 150 + 60 * sign}, {290, 150 + 12 * sign}};
    cv::fillConvexPoly(mask, blade, 255);
    cv::circle(mask, {90, 150 + 35 * sign}, 38, 255, 10);
    cv::line(mask, {120, 150 + 20 * sign}, {300, 150}, 255, 14);
  }
  EXPECT_FALSE(LooksClosed(FindSilhouettes(mask, 1).front()));
}

TEST(LooksClosed, IsNotARodThatRunsOutOfThePicture) {
  const cv::Mat cut = RodWithRings(0)(cv::Rect(0, 0, 450, 300)).clone();
  EXPECT_FALSE(LooksClosed(FindSilhouettes(cut, 1).front()));
}

// Blades to the left whose tips lie beside markers, shanks to the right that the frame cuts before
// their rings: either may be what goes on beyond.
TEST(DescribeShank, SeesTheRingBesideALabelThatLiesOnTheShank) {
  constexpr double kRing = 1.5;  // flare
  const Eigen::Vector2d crotch(20, 150), end(480, 150);
  for (const bool label : {false, true}) {
    cv::Mat mask(300, 500, CV_8UC1, cv::Scalar(0));
    cv::rectangle(mask, {20, 145}, {430, 155}, cv::Scalar(255), cv::FILLED);
    cv::circle(mask, {450, 150}, 30, cv::Scalar(255), cv::FILLED);
    if (label) cv::rectangle(mask, {175, 100}, {235, 200}, cv::Scalar(255), cv::FILLED);
    Silhouette silhouette;
    silhouette.filled = mask;
    EXPECT_GT(DescribeShank(silhouette, {}, {}, end, crotch).flare, kRing) << label;
  }
}

TEST(DescribeShank, SeesTheRingBehindAShortShankAndNoneInABlade) {
  constexpr double kRing = 1.6, kNone = 1;  // flare
  const Eigen::Vector2d crotch(20, 150), end(330, 150);
  Silhouette scissors, blade;
  scissors.filled = cv::Mat::zeros(300, 400, CV_8UC1);
  blade.filled = scissors.filled.clone();
  cv::rectangle(scissors.filled, {20, 144}, {100, 156}, 255, cv::FILLED);
  cv::circle(scissors.filled, {210, 150}, 120, 255, cv::FILLED);
  cv::fillConvexPoly(
      blade.filled, std::vector<cv::Point>{{20, 130}, {100, 125}, {330, 150}, {20, 170}}, 255);
  EXPECT_GT(DescribeShank(scissors, {}, {}, end, crotch).flare, kRing);
  EXPECT_LT(DescribeShank(blade, {}, {}, end, crotch).flare, kNone);
}

// The shadow of a blade beside another blade is no wider for that.
TEST(WidthAcross, IsThatOfTheLimbAlongTheLine) {
  constexpr int kThinPx = 5, kWidePx = 40;
  cv::Mat mask(400, 400, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(98, 20, kThinPx, 360)) = 255;
  mask(cv::Rect(160, 20, kWidePx, 360)) = 255;
  EXPECT_NEAR(WidthAcross(mask, {100, 20}, {100, 380}, 0.5), kThinPx, 1.5);
  EXPECT_NEAR(WidthAcross(mask, {85, 20}, {85, 380}, 0.5), kThinPx, 1.5) << "a bent limb";
  EXPECT_NEAR(WidthAcross(mask, {180, 20}, {180, 380}, 0.5), kWidePx, 1.5);
}

TEST(FindBladePairs, TakesWholeBladesBeforeShanksThatRunOutOfThePicture) {
  cv::Mat mask = cv::Mat::zeros(400, 600, CV_8UC1);
  cv::Mat hidden = cv::Mat::zeros(mask.size(), CV_8UC1);
  const cv::Point joint(250, 200);
  for (const int sign : {-1, 1}) {
    const cv::Point tip(80, 200 - 70 * sign);
    const std::vector<cv::Point> blade{tip + cv::Point(0, 8),
                                       tip + cv::Point(0, -8),
                                       joint + cv::Point(-4, -18),
                                       joint + cv::Point(4, 18)};
    cv::fillConvexPoly(mask, blade, 255);
    cv::line(mask, joint, {700, 200 + 185 * sign}, 255, 14);
    cv::rectangle(hidden, tip + cv::Point(-40, -20), tip + cv::Point(-1, 20), 255, cv::FILLED);
  }
  const std::vector<BladePair> pairs = FindBladePairs(FindSilhouettes(mask, 1).front(), hidden);
  const bool other_reading = std::any_of(pairs.begin(), pairs.end(), [&](const BladePair& pair) {
    return pair.first.cut_off && pair.second.cut_off && pair.quality >= pairs.front().quality;
  });
  EXPECT_TRUE(other_reading) << "is as good by itself";
  for (const BladeContour* blade : {&pairs.front().first, &pairs.front().second}) {
    EXPECT_FALSE(blade->cut_off);
    EXPECT_LT(blade->tip.x(), joint.x);
  }
}

// Two pointed rods that cross look like scissors whose rings are out of the picture, but for the
// width that is left at the frame.
TEST(FindBladePairs, DoubtsShanksThatTaperToTheFrame) {
  constexpr double kPlain = 0.8;
  const auto quality = [](int width_at_frame) {
    cv::Mat mask = cv::Mat::zeros(400, 600, CV_8UC1);
    const cv::Point joint(280, 200), half(2, 12);
    for (const int sign : {-1, 1}) {
      const cv::Point tip(540, 200 - 70 * sign), end(0, 200 + 75 * sign);
      const cv::Point frame(0, width_at_frame / 2);
      const std::vector<cv::Point> blade{tip, joint - half, joint + half};
      const std::vector<cv::Point> shank{end - frame, end + frame, joint + half, joint - half};
      cv::fillConvexPoly(mask, blade, 255);
      cv::fillConvexPoly(mask, shank, 255);
    }
    return FindBladePairs(FindSilhouettes(mask, 1).front(), {}).front().quality;
  };
  EXPECT_GT(quality(20), kPlain);
  EXPECT_GT(quality(14), kPlain);
  EXPECT_LT(quality(2), kPlain);
}

TEST(FindBladePairs, TakesNoShanksForCutOffWhereBladesAre) {
  cv::Mat mask = cv::Mat::zeros(400, 600, CV_8UC1);
  const cv::Point joint(380, 200);
  for (const int sign : {-1, 1}) {
    cv::line(mask, joint, {700, 200 + 120 * sign}, 255, 30);
    cv::line(mask, joint, {160, 200 + 75 * sign}, 255, 16);
    cv::circle(mask, {110, 200 + 92 * sign}, 50, 255, 14);
  }
  const std::vector<BladePair> pairs = FindBladePairs(FindSilhouettes(mask, 1).front(), {});
  ASSERT_FALSE(pairs.empty());
  EXPECT_TRUE(pairs.front().first.cut_off && pairs.front().second.cut_off);
  EXPECT_GT(pairs.front().first.tip.x(), joint.x);
  EXPECT_FALSE(pairs.front().shanks_run_out);
}

// Whatever touches a ring and reaches ahead beside a blade is no part of that.
TEST(FindBladePairs, FindsTheTipsThoughAFingerThatHoldsARingReachesFurther) {
  constexpr double kClosePx = 6, kPlain = 0.8;
  cv::Mat mask = cv::Mat::zeros(460, 600, CV_8UC1);
  const cv::Point joint(300, 200);
  for (const int sign : {-1, 1}) {
    const std::vector<cv::Point> blade{
        {500, 200 - 70 * sign}, joint + cv::Point(-4, -18), joint + cv::Point(4, 18)};
    cv::fillConvexPoly(mask, blade, 255);
    cv::line(mask, joint, {130, 200 + 75 * sign}, 255, 16);
    cv::circle(mask, {90, 200 + 92 * sign}, 40, 255, 14);
  }
  cv::line(mask, {90, 360}, {440, 390}, 255, 60);
  const std::vector<BladePair> pairs = FindBladePairs(FindSilhouettes(mask, 1).front(), {});
  ASSERT_FALSE(pairs.empty());
  EXPECT_GT(pairs.front().quality, kPlain);
  for (const BladeContour* blade : {&pairs.front().first, &pairs.front().second}) {
    const double off_px = std::min((blade->tip - Eigen::Vector2d(500, 130)).norm(),
                                   (blade->tip - Eigen::Vector2d(500, 270)).norm());
    EXPECT_LT(off_px, kClosePx);
  }
}

// What the markers of a small card leave of it, seen a little from the side.
// As of household scissors that open little.
cv::Mat WithRings(int apart_px) {
  cv::Mat mask = cv::Mat::zeros(400, 700, CV_8UC1);
  const cv::Point joint(400, 200);
  for (const int sign : {-1, 1}) {
    const cv::Point tip(640, 200 - 30 * sign), ring(150, 200 + apart_px / 2 * sign);
    const std::vector<cv::Point> blade{tip, joint + cv::Point(0, -18), joint + cv::Point(0, 18)};
    cv::fillConvexPoly(mask, blade, 255);
    cv::line(mask, joint, ring + cv::Point(50, -10 * sign), 255, 16);
    cv::circle(mask, ring, 50, 255, 14);
  }
  return mask;
}

TEST(WithHandlesParted, OpensTheGapBetweenShanksWhoseRingsTouch) {
  constexpr double kPlain = 0.8, kNone = 0.2;
  const cv::Mat touching = WithRings(104), apart = WithRings(130);
  const Silhouette closed = FindSilhouettes(touching, 1).front();
  const std::vector<BladePair> before = FindBladePairs(closed, {});
  EXPECT_TRUE(before.empty() || before.front().quality < kNone);
  double best = 0;
  for (const Silhouette& parted : WithHandlesParted(touching, closed)) {
    for (const BladePair& pair : FindBladePairs(parted, {})) best = std::max(best, pair.quality);
  }
  EXPECT_GT(best, kPlain);
  EXPECT_TRUE(WithHandlesParted(apart, FindSilhouettes(apart, 1).front()).empty());
}

// What is seen in a picture of that light (CV_8UC1), at full resolution.
Candidate LikeOf(const cv::Mat& grey) {
  cv::Mat light;
  grey.convertTo(light, CV_32FC1, 100.0 / 255);
  Candidate like;
  like.at = std::make_shared<const ScaledImage>(ScaledImage{light, cv::Rect({}, grey.size())});
  return like;
}

TEST(SeenIn, TakesTheGapsBetweenMarkersForNoScissors) {
  const cv::Size size(400, 400);
  const auto seen_from_aside = [&](const std::vector<cv::Rect>& rectangles) {
    cv::Mat square = cv::Mat::zeros(size, CV_8UC1), seen;
    for (const cv::Rect& rectangle : rectangles) square(rectangle) = 255;
    const std::vector<cv::Point2f> from{{100, 100}, {300, 100}, {300, 300}, {100, 300}};
    const std::vector<cv::Point2f> to{{112, 98}, {305, 108}, {290, 300}, {98, 285}};
    cv::warpPerspective(
        square, seen, cv::getPerspectiveTransform(from, to), size, cv::INTER_NEAREST);
    return seen;
  };
  const cv::Mat card = seen_from_aside({{100, 100, 200, 200}});
  const cv::Mat hidden =
      seen_from_aside({{98, 98, 97, 97}, {206, 98, 97, 97}, {98, 206, 97, 97}, {206, 206, 97, 97}});
  const cv::Mat mask = card & ~hidden;
  const std::vector<BladePair> pairs = FindBladePairs(FindSilhouettes(mask, 1).front(), hidden);
  ASSERT_FALSE(pairs.empty());
  EXPECT_GT(pairs.front().quality, kAcceptedQuality) << "their outline alone looks like some";
  for (const Candidate& c : SeenIn(mask, LikeOf(mask), hidden, {}).candidates)
    EXPECT_LT(c.pair.quality, kAcceptedQuality);
}

// Blades that the frame cuts on the left, two short limbs on the right.
TEST(SeenIn, TakesNoStubsOfShanksForBlades) {
  cv::Mat mask = cv::Mat::zeros(400, 600, CV_8UC1);
  const cv::Point joint(200, 200);
  const auto along = [&](int sign, int way) { return joint + cv::Point(way, sign * way * 4 / 10); };
  for (const int sign : {-1, 1}) {
    cv::line(mask, joint, along(sign, -300), 255, 34);
    const std::vector<cv::Point> stub{
        along(sign, 150), joint + cv::Point(4, -18), joint + cv::Point(-4, 18)};
    cv::fillConvexPoly(mask, stub, 255);
  }
  const auto sees_stubs = [&] {
    Candidate like = LikeOf(mask);
    like.outlined = true;
    const Rung seen = SeenIn(mask, like, {}, {});
    return std::any_of(seen.candidates.begin(), seen.candidates.end(), [&](const Candidate& c) {
      return c.pair.first.tip.x() > joint.x;
    });
  };
  EXPECT_TRUE(sees_stubs()) << "look like blades";
  for (const int sign : {-1, 1}) cv::line(mask, along(sign, 180), along(sign, 320), 255, 8);
  EXPECT_FALSE(sees_stubs()) << "the limbs go on";
}

// Lines that cross, as of a grid of which a threshold shows some cells, or tapering limbs in their
// stead.
TEST(SeenIn, TakesNoLinesThatCrossForBlades) {
  const cv::Point joint(320, 240);
  const auto sees_blades = [&](int way_px, bool taper) {
    cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
    for (const int sign : {-1, 1}) {
      const cv::Point along(way_px, sign * way_px * 4 / 10), tip = joint + along;
      cv::line(mask, joint, joint - 2 * along, 255, 4);
      cv::circle(mask, joint - 2 * along - cv::Point(way_px / 3, 0), way_px / 3, 255, 4);
      if (taper)
        cv::fillConvexPoly(
            mask, std::vector{tip, joint + cv::Point(0, 4), joint - cv::Point(0, 4)}, 255);
      else
        cv::line(mask, joint, tip, 255, 4);
    }
    return std::ranges::any_of(
        SeenIn(mask, LikeOf(mask), {}, {}).candidates, [&](const Candidate& c) {
          return std::min(c.pair.first.tip.x(), c.pair.second.tip.x()) > joint.x;
        });
  };
  EXPECT_TRUE(sees_blades(50, true));
  EXPECT_FALSE(sees_blades(50, false));
  EXPECT_TRUE(sees_blades(100, false)) << "may be the rims of blades";
}

const cv::Point kJoint(250, 200);

// A place on the lines that cross at the joint, one above and one below it on the right.
cv::Point OnLimb(int sign, int way) { return kJoint + cv::Point(way, sign * way * 4 / 10); }

// Of four limbs that cross at the joint, for those on the right.
bool GoOnToTheRight(const cv::Mat& mask) {
  const std::vector<Silhouette> things = FindSilhouettes(mask, 3);
  const Silhouette& limbs = *ThingAt(things, {kJoint.x, kJoint.y});
  const std::vector<BladePair> pairs = FindBladePairs(limbs, {});
  const auto on_right = std::find_if(pairs.begin(), pairs.end(), [](const BladePair& pair) {
    return std::min(pair.first.tip.x(), pair.second.tip.x()) > kJoint.x;
  });
  EXPECT_NE(on_right, pairs.end());
  return on_right != pairs.end() && GoOnBeyondTips(mask, limbs, *on_right);
}

// Four limbs that cross, and what lies beyond those on the right.
bool GoOnBeyond(const std::function<void(cv::Mat*, const cv::Point&)>& draw_at_tip) {
  cv::Mat mask = cv::Mat::zeros(400, 700, CV_8UC1);
  for (const int sign : {-1, 1}) {
    cv::line(mask, kJoint, OnLimb(sign, -240), 255, 14);
    cv::line(mask, kJoint, OnLimb(sign, 180), 255, 14);
    draw_at_tip(&mask, OnLimb(sign, 230));
  }
  return GoOnToTheRight(mask);
}

TEST(GoOnBeyondTips, IsTrueOfRingsThatTheMaskTearsOffAlone) {
  constexpr int kRadius = 38;
  const cv::Size axes(kRadius, kRadius);
  EXPECT_FALSE(GoOnBeyond([](cv::Mat*, const cv::Point&) {}));
  EXPECT_TRUE(GoOnBeyond([&](cv::Mat* mask, const cv::Point& at) {
    cv::ellipse(*mask, at, axes, 0, 100, 260, 255, 6);
    cv::ellipse(*mask, at, axes, 0, -80, 80, 255, 6);
  }));
  EXPECT_TRUE(GoOnBeyond([&](cv::Mat* mask, const cv::Point& at) {
    cv::ellipse(*mask, at, axes, 0, -170, 170, 255, 1);
  })) << "nothing of them but a line";
  EXPECT_FALSE(GoOnBeyond([&](cv::Mat* mask, const cv::Point& at) {
    if (at.y > 200) cv::ellipse(*mask, at, axes, 0, 0, 300, 255, 6);
  })) << "beyond one of them";
  EXPECT_FALSE(GoOnBeyond([](cv::Mat* mask, const cv::Point& at) {
    cv::rectangle(*mask, {at.x - 20, 20}, {at.x + 60, 380}, 255, cv::FILLED);
  })) << "a ruler";
}

// Blades that the frame cuts on the left; on the right one limb looks like a blade, and beyond the
// other one's end lies part of a ring.
TEST(GoOnBeyondTips, IsTrueOfOneLimbThatDoesNotTaperWhereTheFrameCutsTheOtherEnds) {
  constexpr int kRadius = 38, kLeft = -300, kRight = 180;
  const auto goes_on = [](int ends_left, int width_at_end) {
    cv::Mat mask = cv::Mat::zeros(400, 700, CV_8UC1);
    for (const int sign : {-1, 1}) {
      const cv::Point half(0, (sign < 0 ? 2 : width_at_end) / 2), half_at_joint(0, 8);
      cv::line(mask, kJoint, OnLimb(sign, ends_left), 255, 14);
      const std::vector<cv::Point> limb{kJoint - half_at_joint,
                                        OnLimb(sign, kRight) - half,
                                        OnLimb(sign, kRight) + half,
                                        kJoint + half_at_joint};
      cv::fillConvexPoly(mask, limb, 255);
    }
    const cv::Size axes(kRadius, kRadius);
    cv::ellipse(mask, OnLimb(1, kRight + kRadius + 12), axes, 0, -170, 170, 255, 6);
    return GoOnToTheRight(mask);
  };
  EXPECT_TRUE(goes_on(kLeft, 16));
  EXPECT_FALSE(goes_on(kLeft, 4)) << "a blade, by chance beside something";
  EXPECT_FALSE(goes_on(-200, 16)) << "whole";
}

// On texture, or beside a soft shadow, a threshold's contour may run beside a sharp edge; a soft
// shadow has none near.
TEST(SeenIn, LooksForTheSharpEdgeBesideTheContour) {
  constexpr int kAsidePx = 3;
  cv::Mat pair = cv::Mat::zeros(400, 700, CV_8UC1);
  const cv::Point joint(300, 200);
  for (const int sign : {-1, 1}) {
    const std::vector<cv::Point> blade{
        joint + cv::Point(300, sign * 90), joint + cv::Point(0, 26), joint + cv::Point(0, -26)};
    cv::fillConvexPoly(pair, blade, 255);
    cv::line(pair, joint, joint + cv::Point(-200, sign * 70), 255, 16);
    cv::circle(pair, joint + cv::Point(-230, sign * 80), 36, 255, 12);
  }
  cv::Mat mask;
  const int side = 2 * kAsidePx + 1;
  cv::dilate(pair, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  const auto quality = [&](double blur_px) {
    cv::Mat light;
    cv::GaussianBlur(pair, light, {}, blur_px);
    double best = 0;
    for (const Candidate& c : SeenIn(mask, LikeOf(light), {}, {}).candidates)
      best = std::max(best, c.pair.quality);
    return best;
  };
  constexpr double kAccepted = 0.45, kPlain = 0.85;
  EXPECT_GT(quality(0.5), kAccepted);
  EXPECT_LT(quality(0.5), kPlain) << "it may be another line";
  EXPECT_LT(quality(8), kAccepted);
}

TEST(SceneLadder, LooksAtNothingTwiceAndSeesTheSame) {
  const Photo photo = testing::Measured::PhotoOf(RenderScene(SmallScene()).bgr);
  const std::vector<SeenMarker> no_markers;
  const StoredHints no_hints;
  StageLog log, other_log;
  SceneLadder ladder(photo, no_markers, no_hints, &log);
  EXPECT_GT(ladder.Climb(Plan::kAsNeeded).best.pair.quality, kAcceptedQuality);
  const LadderResult full = ladder.Climb(Plan::kFull);
  std::map<std::string, int> times_run;
  for (const StageRecord& stage : log.records()) times_run[stage.stage] += stage.ran ? 1 : 0;
  EXPECT_EQ(times_run.size(), 5U);
  for (const auto& [stage, times] : times_run) EXPECT_EQ(times, 1) << stage;
  const LadderResult at_once =
      SceneLadder(photo, no_markers, no_hints, &other_log).Climb(Plan::kFull);
  ASSERT_EQ(full.seen.size(), at_once.seen.size());
  EXPECT_EQ(full.best.method, at_once.best.method);
  EXPECT_EQ(full.best.pair.pivot, at_once.best.pair.pivot);
}

TEST(SceneFinder, RefusesClosedScissorsByThatReason) {
  SceneSpec spec = SmallScene();
  spec.theta_rad = -8 * kDegree;  // the edges have passed each other
  EXPECT_EQ(ReasonFor(RenderScene(spec).bgr), "closed");
}

TEST(SceneFinder, RefusesAnEmptySheet) {
  SceneSpec spec = SmallScene();
  spec.with_scissors = false;
  EXPECT_EQ(ReasonFor(RenderScene(spec).bgr), "not_scissors");
}

TEST(SceneFinder, RefusesTipsThatAreCutOff) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const double tip = std::min(photo.truth.upper.end_px.x(), photo.truth.lower.end_px.x());
  const int width =
      static_cast<int>(photo.truth.pivot_px.x() + 0.75 * (tip - photo.truth.pivot_px.x()));
  EXPECT_EQ(ReasonFor(photo.bgr(cv::Rect(0, 0, width, photo.bgr.rows)).clone()),
            "blades_not_visible");
}

// What is left of them ends inside the frame, as blades do.
TEST(SceneFinder, TakesNoShanksForBladesWhoseTipsAreCutOff) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const double pivot = photo.truth.pivot_px.x();
  const double tip = std::min(photo.truth.upper.end_px.x(), photo.truth.lower.end_px.x());
  cv::Mat picture = photo.bgr.colRange(0, static_cast<int>(pivot + 0.75 * (tip - pivot))).clone();
  picture.colRange(0, static_cast<int>(pivot - 200)) = cv::mean(photo.bgr.col(0));
  EXPECT_EQ(ReasonFor(picture), "blades_not_visible");
  SceneHints hints;
  hints.tips_toward = ImageDirection::kLeft;
  EXPECT_NE(ReasonFor(picture, hints), "blades_not_visible") << "whoever says so is obeyed";
}

TEST(SceneFinder, RefusesTwoPairsOfScissors) {
  const cv::Mat one = RenderScene(SmallScene()).bgr;
  cv::Mat two;
  cv::vconcat(one, one, two);
  EXPECT_EQ(ReasonFor(two), "several_scissors");
}

// An instrument of which no blades are seen has rings as well; whoever points at one is obeyed.
TEST(SceneFinder, RefusesAnotherInstrumentByItsRings) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const int pivot = static_cast<int>(photo.truth.pivot_px.x());
  cv::Mat bladeless = photo.bgr.clone(), two;
  bladeless.colRange(pivot - 60, bladeless.cols) = cv::mean(photo.bgr.col(0));
  cv::vconcat(photo.bgr, bladeless, two);
  EXPECT_EQ(ReasonFor(two), "several_scissors");
  SceneHints hints;
  hints.pivot_px = photo.truth.pivot_px;
  EXPECT_EQ(ReasonFor(two, hints), "");
}

// It could not be measured, so that it is not meant; nor are lines that cross at a picture's
// border.
TEST(SceneFinder, TakesTheWholePairBesideOneWhoseBladesRunOut) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const Eigen::Vector2d& pivot = photo.truth.pivot_px;
  const double tip = photo.truth.upper.end_px.x();
  const int seen = static_cast<int>(pivot.x() + 0.95 * (tip - pivot.x()));
  cv::Mat runs_out(photo.bgr.size(), photo.bgr.type(), cv::mean(photo.bgr.col(0))), two;
  photo.bgr.colRange(0, seen).copyTo(runs_out.colRange(runs_out.cols - seen, runs_out.cols));
  cv::vconcat(photo.bgr, runs_out, two);
  EXPECT_EQ(ReasonFor(two), "");
}

// A column right behind the joint.
int BehindJoint(const RenderedPhoto& photo) {
  constexpr double kOfBlade = 0.12;
  const double pivot = photo.truth.pivot_px.x();
  return static_cast<int>(pivot - kOfBlade * (photo.truth.upper.end_px.x() - pivot));
}

// Be it by the frame, or as they lie under a card.
TEST(MeasurePhoto, FindsScissorsWhoseHandlesAreHiddenRightBehindTheJoint) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const int behind = BehindJoint(photo);
  EXPECT_EQ(ReasonFor(photo.bgr.colRange(behind, photo.bgr.cols).clone()), "");
  constexpr int kCardPx = 240;
  cv::Mat under_card = photo.bgr.clone();
  const cv::Rect card(
      behind - kCardPx, static_cast<int>(photo.truth.pivot_px.y()) - kCardPx / 2, kCardPx, kCardPx);
  under_card(card) = cv::Scalar(120, 60, 30);
  EXPECT_EQ(ReasonFor(under_card), "");
}

// Edges that may be a shadow's, as far as their softness tells, and handles that are not seen are
// no two reasons to take them for something else.
TEST(MeasurePhoto, FindsScissorsOutOfFocusWhoseHandlesAreCutOff) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const int behind = BehindJoint(photo);
  for (const double blur_px : {2.0, 3.0}) {
    cv::Mat soft;
    cv::GaussianBlur(photo.bgr.colRange(behind, photo.bgr.cols), soft, {}, blur_px);
    EXPECT_EQ(ReasonFor(soft), "") << blur_px;
  }
}

// In the sun each blade lies beside its shadow: four limbs.
TEST(SceneFinder, TakesNoShadowOfABladeForTheOtherBlade) {
  constexpr std::uint64_t kSeed = 12000194;  // gold blades 20 degrees open on wood
  const SceneSpec spec = RandomScene(kSeed, Difficulty::kSun);
  const RenderedPhoto rendered = RenderScene(spec);
  const Photo photo = testing::Measured::PhotoOf(rendered.bgr);
  StageLog log;
  const Scene scene =
      SceneFinder(photo, FindMarkers(photo.grey(), SrgbToneCurve()), {}, &log).Likeliest();
  const double apart_px = (rendered.truth.upper.end_px - rendered.truth.lower.end_px).norm();
  EXPECT_NEAR((scene.left.tip_px - scene.right.tip_px).norm(), apart_px, 0.3 * apart_px);
}

// As a ground as bright as itself swallows part of a blade.
TEST(SceneFinder, RefusesTwoPairsOfWhichOneLostATip) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const Eigen::Vector2d& pivot = photo.truth.pivot_px;
  const double tip = photo.truth.upper.end_px.x();
  cv::Mat poor = photo.bgr.clone(), two;
  const cv::Range columns(static_cast<int>(pivot.x() + 0.7 * (tip - pivot.x())), poor.cols);
  poor(cv::Range(0, static_cast<int>(pivot.y())), columns) =
      cv::mean(photo.bgr.col(photo.bgr.cols - 1));
  cv::vconcat(photo.bgr, poor, two);
  EXPECT_EQ(ReasonFor(two), "several_scissors");
}

// Edges that run along the rays from the pivot do not cross: a clamp, a forceps, a needle holder.
TEST(MeasurePhoto, RefusesJawsThatMeet) {
  for (const double inclination : {0.005, 0.08}) {
    SceneSpec spec = SmallScene();
    spec.scissors.inclination = inclination;
    spec.scissors.bow_mm = 0;
    const RenderedPhoto photo = RenderScene(spec);
    SceneHints hints;
    hints.pivot_px = photo.truth.pivot_px;
    EXPECT_EQ(ReasonFor(photo.bgr, hints), inclination < 0.04 ? "not_scissors" : "");
  }
}

// Without a screw the edges tell where they turn if they open wide; else the user must.
// A block of metal on a shank's inner side, as clamps carry to be locked.
void PaintCatch(const SceneSpec& spec,
                const EdgeTruth& blade,
                const EdgeTruth& other,
                cv::Mat* bgr) {
  constexpr double kFromPivotMm = 48, kLongMm = 6, kHighMm = 5;
  constexpr double kMetal = 140;
  const Eigen::Vector2d pivot = TruthOf(spec).pivot_px;
  const Eigen::Vector2d along = (pivot - blade.end_px).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d inwards = (pivot - other.end_px).dot(across) > 0 ? across : -across;
  const double px_per_mm = 1 / spec.camera.mm_per_px;
  const Eigen::Vector2d middle = pivot + kFromPivotMm * px_per_mm * along;
  std::vector<cv::Point> corners;
  for (const auto& [along_mm, inwards_mm] :
       {std::pair(-0.5 * kLongMm, 0.0),
        std::pair(0.5 * kLongMm, 0.0),
        std::pair(0.5 * kLongMm, kHighMm + spec.scissors.shank_mm),
        std::pair(-0.5 * kLongMm, kHighMm + spec.scissors.shank_mm)}) {
    const Eigen::Vector2d corner = middle + px_per_mm * (along_mm * along + inwards_mm * inwards);
    corners.emplace_back(static_cast<int>(corner.x()), static_cast<int>(corner.y()));
  }
  cv::fillConvexPoly(*bgr, corners, cv::Scalar::all(kMetal));
}

TEST(MeasurePhoto, RefusesShanksThatCarryTheCatchesOfAClamp) {
  SceneSpec spec = SmallScene();
  spec.theta_rad = 40 * kDegree;
  auto [picture, truth] = RenderScene(spec);
  EXPECT_EQ(ReasonFor(picture), "");
  PaintCatch(spec, truth.upper, truth.lower, &picture);
  EXPECT_EQ(ReasonFor(picture), "");  // on one shank alone: something else
  PaintCatch(spec, truth.lower, truth.upper, &picture);
  EXPECT_EQ(ReasonFor(picture), "not_scissors");
  SceneHints hints;
  hints.pivot_px = truth.pivot_px;
  EXPECT_EQ(ReasonFor(picture, hints), "");
}

// Shanks as a mask shows them.
struct DrawnShanks {
  cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
  BladePair pair;

  // draw(side, mask, at) draws one side, at(x, y) counting x outwards from the middle, and says
  // where the shank ends there.
  template <typename Draw>
  explicit DrawnShanks(const Draw& draw) {
    pair.pivot = {320, 180};
    pair.shank_crotch = {320, 195};
    for (const int side : {-1, 1}) {
      const cv::Point end =
          draw(side, mask, [&](int x, int y) { return cv::Point(320 + side * x, y); });
      (side < 0 ? pair.shank_first : pair.shank_second) = {end.x, end.y};
    }
  }

  [[nodiscard]] bool CarryCatches() const {
    return ShanksCarryCatches(FindSilhouettes(mask, 1).front().filled, pair);
  }
};

// Drawn like DrawnShanks, with rings that the frame cuts.
template <typename Draw>
bool CutShanksCarryCatches(const Draw& draw) {
  constexpr int kFrame = 391;
  DrawnShanks shanks(draw);
  shanks.pair.shanks_run_out = true;
  shanks.mask = shanks.mask.rowRange(0, kFrame);
  return shanks.CarryCatches();
}

// The ends of the shanks are then where the frame cuts the rings' outer rims, and the corners at
// which the shanks meet the rings rise above the lines to there.
TEST(ShanksCarryCatches, TakesNoRingsThatTheFrameCutsForCatches) {
  for (const bool catches : {false, true}) {
    EXPECT_EQ(CutShanksCarryCatches([&](int, cv::Mat& mask, const auto& at) {
                cv::line(mask, at(-60, 40), at(0, 180), 255, 20);
                cv::line(mask, at(0, 180), at(108, 385), 255, 12);
                cv::circle(mask, at(173, 405), 65, 255, 6);
                if (catches) cv::line(mask, at(70, 310), at(55, 320), 255, 14);
                return at(240, 390);
              }),
              catches);
  }
}

// Where the frame cuts them in the middle, they begin well before the ends of the shanks.
TEST(ShanksCarryCatches, TakesNoHalfRingsForCatches) {
  for (const bool catches : {false, true}) {
    EXPECT_EQ(CutShanksCarryCatches([&](int, cv::Mat& mask, const auto& at) {
                cv::line(mask, at(0, 180), at(96, 340), 255, 18);
                cv::circle(mask, at(150, 390), 62, 255, 16);
                if (catches) cv::line(mask, at(58, 290), at(42, 300), 255, 16);
                return at(200, 390);
              }),
              catches);
  }
}

// A shadow makes one shank look wider than the other, and its catch lower.
TEST(ShanksCarryCatches, FindsTheCatchOfAShankThatLooksWide) {
  for (const bool catches : {false, true}) {
    const DrawnShanks shanks([&](int side, cv::Mat& mask, const auto& at) {
      cv::line(mask, at(0, 180), at(108, 385), 255, 12);
      cv::circle(mask, at(120, 412), 30, 255, 6);
      if (side > 0) cv::line(mask, at(8, 184), at(112, 380), 255, 12);
      if (catches) cv::line(mask, at(74, 310), at(62, 317), 255, 12);
      return at(135, 438);
    });
    EXPECT_EQ(shanks.CarryCatches(), catches);
  }
}

// The shanks part where a shadow fills their crotch on one side only, so that one catch seems to
// lie further off.
TEST(ShanksCarryCatches, FindsPlainlyHighOnesAtDistancesThatDiffer) {
  for (const auto& [high_px, found] : {std::pair(8, false), std::pair(24, true)}) {
    const DrawnShanks shanks([&, high = high_px](int side, cv::Mat& mask, const auto& at) {
      cv::line(mask, at(0, 180), at(108, 385), 255, 12);
      cv::circle(mask, at(120, 412), 30, 255, 6);
      const int further = side > 0 ? 20 : 0;
      const cv::Point from = at(72 + further / 2, 305 + further);
      cv::line(mask, from, at(72 + further / 2 - high, 305 + further + high / 2), 255, 12);
      return at(135, 438);
    });
    EXPECT_EQ(shanks.CarryCatches(), found) << high_px;
  }
}

// Grips on slender shanks rise as catches do, and bend outwards from there.
TEST(ShanksCarryCatches, TakesNoGripsForCatches) {
  for (const bool catches : {false, true}) {
    const DrawnShanks shanks([&](int, cv::Mat& mask, const auto& at) {
      cv::line(mask, at(0, 180), at(72, 325), 255, 7);
      cv::line(mask, at(66, 313), at(120, 372), 255, 18);
      cv::circle(mask, at(138, 405), 34, 255, 8);
      if (catches) cv::line(mask, at(50, 280), at(32, 290), 255, 12);
      return at(150, 438);
    });
    EXPECT_EQ(shanks.CarryCatches(), catches);
  }
}

// Blades of another pair that lies on the first one, joint on joint.
TEST(CountLimbsAhead, CountsTheBladesOfPairsThatLieOnEachOther) {
  constexpr double kBladePx = 200, kShankPx = 240;
  const Eigen::Vector2d pivot(320, 240);
  cv::Mat mask(480, 640, CV_8UC1, cv::Scalar(0));
  const auto from_pivot = [&](double direction_deg, double way_px) {
    const double direction = direction_deg * kDegree;
    return Eigen::Vector2d(pivot +
                           way_px * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
  };
  const auto draw = [&](double direction_deg, double way_px, int width_px) {
    const Eigen::Vector2d end = from_pivot(direction_deg, way_px);
    cv::line(mask, {320, 240}, cv::Point2d(end.x(), end.y()), 255, width_px);
  };
  BladePair pair;
  pair.pivot = pivot;
  pair.first.width = pair.second.width = 14;
  pair.first.tip = from_pivot(-15, kBladePx);
  pair.second.tip = from_pivot(15, kBladePx);
  for (const int side : {-1, 1}) {
    draw(15 * side, kBladePx, 14);
    draw(180 + 70 * side, kShankPx, 14);
  }
  pair.shank_first = from_pivot(110, kShankPx);
  pair.shank_second = from_pivot(250, kShankPx);
  EXPECT_EQ(CountLimbsAhead(mask, pair), 2);
  cv::Mat on_ruler = mask.clone();
  cv::rectangle(on_ruler, {120, 290}, {455, 390}, 255, cv::FILLED);
  EXPECT_EQ(CountLimbsAhead(on_ruler, pair), 2) << "too wide for a blade";
  const auto on = [&](const std::vector<std::pair<double, double>>& corners) {
    cv::Mat lying_on = mask.clone();
    std::vector<cv::Point> outline;
    for (const auto& [direction_deg, way_px] : corners) {
      const Eigen::Vector2d corner = from_pivot(direction_deg, way_px);
      outline.emplace_back(static_cast<int>(corner.x()), static_cast<int>(corner.y()));
    }
    cv::fillConvexPoly(lying_on, outline, 255);
    return lying_on;
  };
  const cv::Mat on_card = on({{40, 40}, {40, 220}, {90, 220}, {90, 40}});
  EXPECT_EQ(CountLimbsAhead(on_card, pair), 2) << "too wide, and wholly ahead";
  const cv::Mat on_label = on({{112, 60}, {90, 200}, {130, 200}, {120, 60}});
  BladePair with_straight_shanks = pair;
  with_straight_shanks.shank_first = from_pivot(160, kShankPx);
  with_straight_shanks.shank_second = from_pivot(200, kShankPx);
  EXPECT_EQ(CountLimbsAhead(on_label, with_straight_shanks), 2) << "reaches behind the blades";
  draw(75, 0.5 * kBladePx, 14);
  EXPECT_EQ(CountLimbsAhead(mask, pair), 2) << "too short for a blade";
  draw(75, kBladePx, 14);
  EXPECT_EQ(CountLimbsAhead(mask, pair), 3);
  draw(-60, kBladePx, 14);
  EXPECT_EQ(CountLimbsAhead(mask, pair), 4);
}

// Scissors as a sketch, their blades turned aside at the joint.
cv::Mat SketchTurnedBy(double turn_rad) {
  constexpr double kHalfOpening = 0.25, kBladePx = 230, kShankPx = 300, kHalfWidePx = 20;
  cv::Mat picture(750, 1000, CV_8UC3, cv::Scalar::all(225));
  const cv::Point2d joint(500, 375);
  const auto from_joint = [&](double direction, double ahead_px, double aside_px) {
    return cv::Point(joint +
                     cv::Point2d(ahead_px * std::cos(direction) - aside_px * std::sin(direction),
                                 ahead_px * std::sin(direction) + aside_px * std::cos(direction)));
  };
  const cv::Scalar metal = cv::Scalar::all(90);
  for (const int side : {-1, 1}) {
    const double blade = turn_rad + side * kHalfOpening;
    const double shank = std::numbers::pi + side * kHalfOpening;
    // The cutting edge passes the joint on its far side.
    const std::vector<cv::Point> outline{from_joint(blade, kBladePx, 0),
                                         from_joint(blade, 0, -side * 0.5 * kHalfWidePx),
                                         from_joint(blade, 0, side * 1.5 * kHalfWidePx)};
    cv::fillConvexPoly(picture, outline, metal, cv::LINE_AA);
    cv::line(picture, joint, from_joint(shank, kShankPx, 0), metal, 18, cv::LINE_AA);
    cv::circle(picture, from_joint(shank, kShankPx + 40, 0), 42, metal, 12, cv::LINE_AA);
  }
  cv::GaussianBlur(picture, picture, {}, 0.8);
  return picture;
}

TEST(SceneFinder, RefusesBladesSetAtAnAngle) {
  EXPECT_NE(ReasonFor(SketchTurnedBy(0)), "out_of_plane");
  for (const double turn_deg : {-40.0, 30.0})
    EXPECT_EQ(ReasonFor(SketchTurnedBy(turn_deg * kDegree)), "out_of_plane") << turn_deg;
}

// Quality of the sketch's blades where the gap between them is that light, 0 to 100.
double QualityWithGap(double gap) {
  constexpr double kGround = 60, kMetal = 30;
  cv::Mat grey, mask;
  cv::cvtColor(SketchTurnedBy(0), grey, cv::COLOR_BGR2GRAY);
  cv::threshold(grey, mask, 160, 255, cv::THRESH_BINARY_INV);
  cv::Mat light(grey.size(), CV_32FC1, cv::Scalar(kGround));
  const std::vector<cv::Point> between{{500, 375}, {723, 318}, {723, 432}};  // joint and tips
  cv::fillConvexPoly(light, between, cv::Scalar(gap));
  light.setTo(kMetal, mask);
  Candidate like;
  like.at = std::make_shared<const ScaledImage>(ScaledImage{light, cv::Rect({}, light.size())});
  const Rung seen = SeenIn(mask, like, {}, {});
  double best = 0;
  for (const Candidate& c : seen.candidates) best = std::max(best, c.pair.quality);
  return best;
}

// A blade that shines passes for the gap between the other one and its own shadow.
TEST(SeenIn, TakesWhatShinesForNoGap) {
  EXPECT_GT(QualityWithGap(60), 0.9);
  EXPECT_GT(QualityWithGap(40), 0.9) << "in the blades' shadows";
  EXPECT_GT(QualityWithGap(65), 0.9);
  EXPECT_EQ(QualityWithGap(80), 0);
}

// A mask that shows blades of 100 px, turned by `turn` against their shanks.
Candidate MaskWithTurn(double turn_rad) {
  const auto at = [](double direction) {
    return Eigen::Vector2d(100 * std::cos(direction), 100 * std::sin(direction));
  };
  constexpr double kHalfOpening = 0.25;
  Candidate c;
  const cv::Mat light(100, 100, CV_32FC1);
  const cv::Rect whole({}, light.size());
  c.at = std::make_shared<const ScaledImage>(ScaledImage{light, whole});
  c.pair.quality = 1;
  c.pair.pivot = {0, 0};
  c.pair.first.length = c.pair.second.length = 100;
  c.pair.first.tip = at(-kHalfOpening);
  c.pair.second.tip = at(kHalfOpening);
  c.pair.shank_first = 1.5 * at(std::numbers::pi - turn_rad - kHalfOpening);
  c.pair.shank_second = 1.5 * at(std::numbers::pi - turn_rad + kHalfOpening);
  return c;
}

// The clearest mask alone may have lost what the others show.
TEST(TurnAtJoint, IsThatOfMostMasksOfTheSameBlades) {
  constexpr double kTurned = 0.5;
  LadderResult ladder;
  ladder.best = MaskWithTurn(0);
  ladder.seen = {ladder.best, MaskWithTurn(kTurned), MaskWithTurn(kTurned)};
  EXPECT_NEAR(TurnAtJoint(ladder), kTurned, 1e-9);
  Candidate poor = MaskWithTurn(0);
  poor.pair.quality = 0.5 * kAcceptedQuality;
  Candidate elsewhere = MaskWithTurn(0);
  for (Eigen::Vector2d* place :
       {&elsewhere.pair.pivot, &elsewhere.pair.first.tip, &elsewhere.pair.second.tip})
    *place += Eigen::Vector2d(300, 0);
  for (int i = 0; i < 3; ++i) {
    ladder.seen.push_back(poor);
    ladder.seen.push_back(elsewhere);
  }
  EXPECT_NEAR(TurnAtJoint(ladder), kTurned, 1e-9) << "poor masks and other things do not count";
  ladder.seen.push_back(MaskWithTurn(0));
  ladder.seen.push_back(MaskWithTurn(0));
  EXPECT_NEAR(TurnAtJoint(ladder), 0, 1e-9);
}

// One mask of its method that shows something else as well does not outweigh what several show.
TEST(Choose, CountsTheMasksOfAllMethods) {
  const auto seen = [](const char* method, double quality, double strength, double aside) {
    Candidate c = MaskWithTurn(0);
    c.method = method;
    c.pair.quality = quality;
    c.strength = strength;
    c.agreeing = 1;
    for (Eigen::Vector2d* place : {&c.pair.pivot, &c.pair.first.tip, &c.pair.second.tip})
      place->x() += aside;
    return c;
  };
  const Candidate elsewhere = seen("shadow-blind", 0.7, 10, 300);
  const Candidate likely = seen("regions", 0.65, 6, 0);
  EXPECT_EQ(Choose({elsewhere, likely}).best.method, "shadow-blind");
  const Candidate fair = seen("flood", 0.4, 6, 0);
  EXPECT_EQ(Choose({elsewhere, likely, fair}).best.method, "regions");
  const Candidate unlikely = seen("flood", 0.2, 6, 0);
  EXPECT_EQ(Choose({elsewhere, likely, unlikely}).best.method, "shadow-blind");
}

// The end of a shank of which a card hides the rest tells no direction.
TEST(TurnAtJoint, IsNoneOfAShankShorterThanTheBlades) {
  constexpr double kTurned = 0.5;
  BladePair pair = MaskWithTurn(kTurned).pair;
  EXPECT_NEAR(TurnAtJoint(pair), kTurned, 1e-9);
  pair.shank_first *= 0.6;
  EXPECT_EQ(TurnAtJoint(pair), 0);
}

TEST(MeasurePhoto, RefusesAPivotThatNothingTells) {
  SceneSpec spec = SmallScene();
  spec.scissors.screw_visible = false;
  spec.theta_rad = 50 * kDegree;
  EXPECT_EQ(ReasonFor(RenderScene(spec).bgr), "");
  spec.theta_rad = 7 * kDegree;
  const RenderedPhoto narrow = RenderScene(spec);
  EXPECT_EQ(ReasonFor(narrow.bgr), "ambiguous_pivot");
  SceneHints hints;
  hints.pivot_px = narrow.truth.pivot_px;
  EXPECT_EQ(ReasonFor(narrow.bgr, hints), "");
}

TEST(MeasurePhoto, TakesNoPairThatDoesNotTurnAboutTheGivenPivot) {
  const RenderedPhoto photo = RenderScene(SmallScene());
  const SceneTruth& truth = photo.truth;
  const Eigen::Vector2d to_tips = 0.5 * (truth.upper.end_px + truth.lower.end_px) - truth.pivot_px;
  const Eigen::Vector2d across = Eigen::Vector2d(-to_tips.y(), to_tips.x());
  const auto about = [&](double along, double aside) {
    SceneHints hints;
    hints.pivot_px = truth.pivot_px + along * to_tips + aside * across;
    return ReasonFor(photo.bgr, hints);
  };
  EXPECT_EQ(about(0, 0), "");
  EXPECT_EQ(about(0.02, 0.02), "") << "pointed to in a hurry";
  EXPECT_EQ(about(0.6, 0), "not_scissors");
  EXPECT_EQ(about(-1, 0), "not_scissors");
  EXPECT_EQ(about(0, 0.4), "not_scissors");
}

TEST(SceneFinder, MeasuresOnEveryBackdrop) {
  for (const Backdrop backdrop : {Backdrop::kPaper,
                                  Backdrop::kCloth,
                                  Backdrop::kDrape,
                                  Backdrop::kWood,
                                  Backdrop::kBlack,
                                  Backdrop::kLightTable,
                                  Backdrop::kCutOut}) {
    SceneSpec spec = SmallScene();
    spec.backdrop = backdrop;
    EXPECT_EQ(ReasonFor(RenderScene(spec).bgr), "") << "backdrop " << static_cast<int>(backdrop);
  }
}

// The scissors on another ground: print(ground) paints it.
template <typename Print>
cv::Mat OnGround(SceneSpec spec, const Print& print) {
  constexpr int kScissors = 12;
  spec.backdrop = Backdrop::kDrape;
  spec.drape_rgb = {0.01, 0.05, 0.03};
  spec.texture = spec.light.shadow = spec.light.contact_shadow = 0;
  const cv::Mat picture = RenderScene(spec).bgr;
  spec.with_scissors = false;
  cv::Mat differs, ground = RenderScene(spec).bgr;
  cv::absdiff(picture, ground, differs);
  cv::cvtColor(differs, differs, cv::COLOR_BGR2GRAY);
  print(ground);
  cv::GaussianBlur(ground, ground, {}, 0.8);
  picture.copyTo(ground, differs > kScissors);
  return ground;
}

// A mat with a printed grid of lines as bright as the blades.
cv::Mat OnCuttingMat(const SceneSpec& spec) {
  constexpr int kCellPx = 28, kLinePx = 3;
  const cv::Scalar light(156, 195, 130);
  return OnGround(spec, [&](cv::Mat& mat) {
    for (int at = -mat.cols; at < 2 * mat.cols; at += kCellPx) {
      cv::line(mat, {at, 0}, {at + mat.rows / 2, mat.rows}, light, kLinePx);
      cv::line(mat, {0, at}, {mat.cols, at - mat.cols / 2}, light, kLinePx);
    }
  });
}

// Planks in several paints, darker and brighter than the blades.
cv::Mat OnPaintedPlanks(const SceneSpec& spec) {
  constexpr int kPlankPx = 46;
  const std::array paints{
      cv::Scalar(150, 120, 20), cv::Scalar(30, 60, 90), cv::Scalar(40, 215, 235)};
  return OnGround(spec, [&](cv::Mat& planks) {
    for (int at = 0, k = 0; at < planks.cols + planks.rows; at += kPlankPx, ++k) {
      const cv::Scalar& paint = paints[static_cast<std::size_t>(k) % paints.size()];
      const std::vector<cv::Point> plank{{at, 0},
                                         {at + kPlankPx, 0},
                                         {at + kPlankPx - planks.rows, planks.rows},
                                         {at - planks.rows, planks.rows}};
      cv::fillConvexPoly(planks, plank, paint);
    }
  });
}

TEST(SceneFinder, SeesScissorsOnACuttingMat) {
  const SceneSpec spec = SmallScene();
  const SceneTruth truth = TruthOf(spec);
  const Photo photo = testing::Measured::PhotoOf(OnCuttingMat(spec));
  StageLog log;
  const Scene scene = SceneFinder(photo, {}, {}, &log).Likeliest();
  const double near_px = 0.1 * (truth.upper.end_px - truth.pivot_px).norm();
  EXPECT_LT((scene.left.tip_px - truth.upper.end_px).norm(), near_px);
  EXPECT_LT((scene.right.tip_px - truth.lower.end_px).norm(), near_px);
}

TEST(SceneFinder, SeesScissorsThatThePivotPointsAtOnPaintedPlanks) {
  const SceneSpec spec = SmallScene();
  const SceneTruth truth = TruthOf(spec);
  const cv::Mat picture = OnPaintedPlanks(spec);
  EXPECT_EQ(ReasonFor(picture), "") << "the screw confirms what blades and joint show";
  const Photo photo = testing::Measured::PhotoOf(picture);
  StageLog log;
  StoredHints hints;
  hints.pivot_px = truth.pivot_px;
  const Scene scene = SceneFinder(photo, {}, hints, &log).Likeliest();
  EXPECT_TRUE(std::ranges::any_of(log.records(), [](const StageRecord& stage) {
    return stage.ran && stage.stage == "scene-cut";
  }));
  const double near_px = 0.1 * (truth.upper.end_px - truth.pivot_px).norm();
  EXPECT_LT((scene.left.tip_px - truth.upper.end_px).norm(), near_px);
  EXPECT_LT((scene.right.tip_px - truth.lower.end_px).norm(), near_px);
}

// Members cross: a blade's own shank lies behind the joint, on the other side of the axis, and its
// side that faces as the cutting edge does is the far one.
TEST(SceneFinder, ShowsTheSideOfEachShankThatFacesAsTheCuttingEdgeDoes) {
  const Photo photo = testing::Measured::PhotoOf(RenderScene(SmallScene()).bgr);
  StageLog log;
  const Scene scene = SceneFinder(photo, {}, {}, &log).Likeliest();
  const Eigen::Vector2d axis = (scene.crotch_px - scene.shank_crotch_px).normalized();
  const Eigen::Vector2d to_right(-axis.y(), axis.x());  // seen towards the tips, y down
  for (const SceneBlade* blade : {&scene.left, &scene.right}) {
    const double own_side = blade == &scene.left ? 1 : -1;
    EXPECT_LT(own_side * (blade->tip_px - scene.pivot_px).dot(to_right), 0);
    ASSERT_GT(blade->shank_px.size(), 20U);
    for (const Eigen::Vector2d& p : blade->shank_px) {
      EXPECT_LT((p - scene.shank_crotch_px).dot(axis), 1);
      EXPECT_GT(own_side * (p - scene.pivot_px).dot(to_right), 0.3 * scene.shank_width_px);
    }
    EXPECT_GT((blade->shank_px.back() - scene.pivot_px).norm(),
              (blade->shank_px.front() - scene.pivot_px).norm());
  }
}

TEST(SceneFinder, ShowsTheSameScissorsAtEveryLook) {
  const Photo photo = testing::Measured::PhotoOf(RenderScene(SmallScene()).bgr);
  StageLog log;
  SceneFinder finder(photo, {}, {}, &log);
  const Scene likeliest = finder.Likeliest();
  EXPECT_FALSE(likeliest.IsDoubtful());
  const double near_px = 0.2 * (likeliest.left.tip_px - likeliest.pivot_px).norm();
  for (int look = 2; look <= SceneFinder::kLooks; ++look) {
    finder.LookAgain();
    const Scene again = finder.Likeliest();
    EXPECT_TRUE(again.second_look && again.IsDoubtful()) << "look " << look;
    EXPECT_EQ(again.warnings, std::vector<std::string>{"scene_doubtful"});
    EXPECT_LT((again.pivot_px - likeliest.pivot_px).norm(), near_px);
    EXPECT_LT((again.left.tip_px - likeliest.left.tip_px).norm(), near_px);
    EXPECT_LT((again.right.tip_px - likeliest.right.tip_px).norm(), near_px);
  }
}

// One mask shows the joint elsewhere, but the same blades.
TEST(LadderResult, TakesPairsThatEndInTheSameBladesForOne) {
  const auto seen = [](double joint_x, double tips_x) {
    Candidate c = MaskWithTurn(0);
    c.method = "grey";
    c.strength = 1;
    c.agreeing = 5;
    c.mask = cv::Mat(1, 1, CV_8UC1);
    c.pair.quality = 0.85;
    c.pair.pivot = {joint_x, 100};
    c.pair.first.tip = {tips_x, 80};
    c.pair.second.tip = {tips_x, 120};
    c.pair.first.length = c.pair.second.length = 60;
    return c;
  };
  const auto several = [](const Candidate& a, const Candidate& b) {
    LadderResult all;
    all.seen = {a, b};
    return ByOtherMethods(all, "flood").several;
  };
  EXPECT_FALSE(several(seen(100, 160), seen(20, 160)));
  EXPECT_TRUE(several(seen(100, 160), seen(300, 360)));
}

// The second look is by all other methods, the third by the other masks of the likeliest one.
TEST(LadderResult, IsChosenAnewByOtherMethodsAndMasks) {
  const auto seen = [](const std::string& method, double quality) {
    Candidate c = MaskWithTurn(0);
    c.method = method;
    c.pair.quality = quality;
    c.strength = 1;
    c.agreeing = 1;
    c.mask = cv::Mat(1, 1, CV_8UC1);
    return c;
  };
  LadderResult all;
  all.closed = true;
  all.seen = {seen("flood", 0.6),
              seen("flood", 0.7),
              seen("grey", 0.6),
              seen("grey", 0.9),
              seen("grey", 0.8)};
  all.best = all.seen[3];
  all.unresolved = {seen("flood", 0)};
  const LadderResult other_methods = ByOtherMethods(all, "grey");
  EXPECT_EQ(other_methods.best.mask.data, all.seen[1].mask.data);
  EXPECT_EQ(other_methods.seen.size(), 2U);
  EXPECT_EQ(other_methods.unresolved.size(), 1U);
  const LadderResult other_masks = ByOtherMasks(all);
  EXPECT_EQ(other_masks.best.mask.data, all.seen[4].mask.data);
  EXPECT_EQ(other_masks.seen.size(), 2U);
  EXPECT_TRUE(other_methods.closed && other_masks.closed);
  EXPECT_EQ(ByOtherMethods(other_methods, "flood").best.pair.quality, 0);
}

// The waist of open scissors is wider than the members that cross there.
TEST(SceneFinder, TellsTheSameWidthOfMembersAtAnyOpening) {
  const auto width_at = [](double opening_deg) {
    SceneSpec spec = SmallScene();
    spec.theta_rad = opening_deg * kDegree;
    const Photo photo = testing::Measured::PhotoOf(RenderScene(spec).bgr);
    StageLog log;
    return SceneFinder(photo, {}, {}, &log).Likeliest().shank_width_px;
  };
  const double narrow = width_at(20);
  EXPECT_NEAR(width_at(50), narrow, 0.12 * narrow);
  EXPECT_NEAR(width_at(80), narrow, 0.12 * narrow);
}

// Thresholds see the blade without its bevel and agree on that; only the flood sees all of it.
TEST(SceneFinder, SeesABevelAsBrightAsThePaper) {
  SceneSpec spec;
  spec.seed = 13;
  spec.camera.mm_per_px = 0.1;
  spec.light.direction_rad = 13 * 0.39;
  spec.scissors.slot_rad = 13 * 0.7;
  const RenderedPhoto photo = RenderScene(spec);
  const fs::path file = ProcessFolder() / "bevel.jpg";
  std::ofstream(file, std::ios::binary) << EncodeJpeg(photo.bgr, 95);
  MeasureOptions options;
  options.scale.mm_per_px = photo.truth.mm_per_px;
  const PhotoMeasurement measured = MeasurePhoto(file, options);
  EXPECT_NEAR(measured.theta_rad, photo.truth.theta_rad, 0.1 * kDegree);
  EXPECT_LT((measured.upper_end_px - photo.truth.upper.end_px).norm(), 5);
}

}  // namespace
}  // namespace bladecurve
