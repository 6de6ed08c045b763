// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "vision/screw_images.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A head of the given radius somewhere near the middle, up to 30 degrees from being seen from
// above.
HeadSpec RandomHead(double radius, std::uint32_t seed) {
  Draws draws(seed);
  HeadSpec head;
  head.seed = seed;
  head.side_px = 6 * static_cast<int>(radius) + 21;
  head.center_px =
      Vector2d::Constant(head.side_px / 2.0) + Vector2d(draws.Uniform(-1, 1), draws.Uniform(-1, 1));
  head.semi_major_px = radius;
  head.semi_minor_px = radius * draws.Uniform(0.87, 1);
  head.angle_rad = draws.Uniform(0, std::numbers::pi);
  head.slot_angle_rad = draws.Uniform(0, std::numbers::pi);
  return head;
}

ScrewSearch SearchAround(const Vector2d& guess, double radius) {
  ScrewSearch search;
  search.guess_px = guess;
  search.radius_px = 1.5 * radius;
  search.min_semi_axis_px = 0.45 * radius;
  search.max_semi_axis_px = 1.9 * radius;
  return search;
}

// From a guess that is off by up to 1.4 radii.
std::optional<Screw> Find(const cv::Mat& grey, const HeadSpec& head) {
  Draws draws(head.seed + 1000);
  const double direction = draws.Uniform(0, 2 * std::numbers::pi);
  const double off = 1.4 * head.semi_major_px * std::sqrt(draws.Uniform());
  const Vector2d guess = head.center_px + off * Vector2d(std::cos(direction), std::sin(direction));
  return FindScrew(grey, SrgbToneCurve(), SearchAround(guess, head.semi_major_px));
}

enum class Look { kDisc, kGroove, kRing, kSlotted };

HeadSpec Dressed(HeadSpec head, Look look) {
  switch (look) {
    case Look::kDisc:
      head.disc = 0.2;
      break;
    case Look::kGroove:
      head.groove = -0.2;
      break;
    case Look::kRing:
      head.groove = 0.3;
      break;
    case Look::kSlotted:
      head.disc = -0.15;
      head.slot = -0.12;
      break;
  }
  return head;
}

constexpr Look kLooks[] = {Look::kDisc, Look::kGroove, Look::kRing, Look::kSlotted};

TEST(FindScrew, CenterOfCleanHeadsIsWithinThreeHundredthsOfAPixel) {
  for (const Look look : kLooks) {
    for (const double radius : {15.0, 30.0, 60.0}) {
      constexpr int kDraws = 16;
      double sum = 0;
      for (std::uint32_t seed = 1; seed <= kDraws; ++seed) {
        const HeadSpec head = Dressed(RandomHead(radius, seed), look);
        const std::optional<Screw> screw = Find(RenderHead(head), head);
        ASSERT_TRUE(screw) << "look " << static_cast<int>(look) << " radius " << radius << " seed "
                           << seed;
        sum += (screw->center_px - head.center_px).squaredNorm() / 2;
      }
      EXPECT_LE(std::sqrt(sum / kDraws), 0.03)
          << "rms of a coordinate; look " << static_cast<int>(look) << " radius " << radius;
    }
  }
}

// Where the rim runs with the brushing it is lost in grain; weighed alike all round, such heads are
// off by 0.04 px.
TEST(FindScrew, BrushedMetalLeavesThreeHundredthsOfAPixelToLargeHeads) {
  constexpr int kDraws = 16;
  double sum = 0;
  for (std::uint32_t seed = 1; seed <= kDraws; ++seed) {
    HeadSpec head = Dressed(RandomHead(60, seed), Look::kSlotted);
    head.brushed = 0.04;
    const std::optional<Screw> screw = Find(RenderHead(head), head);
    ASSERT_TRUE(screw) << "seed " << seed;
    sum += (screw->center_px - head.center_px).squaredNorm() / 2;
  }
  EXPECT_LE(std::sqrt(sum / kDraws), 0.03);
}

TEST(FindScrew, SmallHeadsAreFoundOrLeftAlone) {
  int found = 0, seen = 0;
  for (const double radius : {5.0, 7.0, 9.0}) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed, ++seen) {
      const HeadSpec head = Dressed(RandomHead(radius, seed), Look::kGroove);
      const std::optional<Screw> screw = Find(RenderHead(head), head);
      if (!screw) continue;
      ++found;
      EXPECT_LT((screw->center_px - head.center_px).norm(), 0.3)
          << "radius " << radius << " seed " << seed;
    }
  }
  EXPECT_GE(found, seen * 8 / 10);
}

// chi^2 of two coordinates has mean 2; over 120 draws its mean scatters by 0.18, and the covariance
// of each is estimated from two dozen blocks only, so it is meant to be a little wide.
TEST(FindScrew, CovarianceMatchesTheScatterOverManyPictures) {
  constexpr int kDraws = 120;
  double sum = 0;
  int inside = 0;
  for (std::uint32_t seed = 1; seed <= kDraws; ++seed) {
    const HeadSpec head = Dressed(RandomHead(18 + seed % 12, seed), kLooks[seed % 3]);
    const std::optional<Screw> screw = Find(RenderHead(head), head);
    ASSERT_TRUE(screw) << "seed " << seed;
    const Vector2d error = screw->center_px - head.center_px;
    const double chi2 = error.dot(screw->covariance_px2.inverse() * error);
    sum += chi2;
    if (chi2 < 5.991) ++inside;  // 95 %
  }
  EXPECT_LT(sum / kDraws, 2.6);
  EXPECT_GT(sum / kDraws, 1.2);
  EXPECT_GE(inside, kDraws * 90 / 100);
}

TEST(FindScrew, SizeAndDirectionOfTheEllipseAreThoseOfTheHead) {
  HeadSpec head = RandomHead(30, 4);
  head.disc = 0.2;
  head.semi_minor_px = 26;
  head.angle_rad = 0.5;
  const std::optional<Screw> screw = Find(RenderHead(head), head);
  ASSERT_TRUE(screw);
  EXPECT_NEAR(screw->semi_major_px, 30, 0.15);
  EXPECT_NEAR(screw->semi_minor_px, 26, 0.15);
  EXPECT_NEAR(screw->angle_rad, 0.5, 0.02);
  EXPECT_GT(screw->support, 0.9);
}

// Interpolation and the order of the search differ, the rim does not.
TEST(FindScrew, TurningOrMirroringThePictureDoesTheSameToTheCenter) {
  for (const Look look : kLooks) {
    const HeadSpec head = Dressed(RandomHead(20, 11), look);
    const cv::Mat grey = RenderHead(head);
    const ScrewSearch search = SearchAround(head.center_px + Vector2d(6, -4), 20);
    const std::optional<Screw> screw = FindScrew(grey, SrgbToneCurve(), search);
    ASSERT_TRUE(screw);
    cv::Mat turned, mirrored;
    cv::rotate(grey, turned, cv::ROTATE_90_CLOCKWISE);  // (x, y) -> (rows - 1 - y, x)
    cv::flip(grey, mirrored, 1);
    const auto turn = [&](const Vector2d& p) { return Vector2d(grey.rows - 1 - p.y(), p.x()); };
    const auto mirror = [&](const Vector2d& p) { return Vector2d(grey.cols - 1 - p.x(), p.y()); };
    ScrewSearch turned_search = search, mirrored_search = search;
    turned_search.guess_px = turn(search.guess_px);
    mirrored_search.guess_px = mirror(search.guess_px);
    const std::optional<Screw> a = FindScrew(turned, SrgbToneCurve(), turned_search);
    const std::optional<Screw> b = FindScrew(mirrored, SrgbToneCurve(), mirrored_search);
    ASSERT_TRUE(a && b);
    EXPECT_LT((a->center_px - turn(screw->center_px)).norm(), 0.02);
    EXPECT_LT((b->center_px - mirror(screw->center_px)).norm(), 0.02);
  }
}

TEST(FindScrew, GuessDoesNotMoveTheCenter) {
  const HeadSpec head = Dressed(RandomHead(20, 3), Look::kSlotted);
  const cv::Mat grey = RenderHead(head);
  const std::optional<Screw> first =
      FindScrew(grey, SrgbToneCurve(), SearchAround(head.center_px, 20));
  ASSERT_TRUE(first);
  for (const Vector2d& off : {Vector2d(15, 0), Vector2d(0, -20), Vector2d(-12, 14)}) {
    const std::optional<Screw> other =
        FindScrew(grey, SrgbToneCurve(), SearchAround(head.center_px + off, 20));
    ASSERT_TRUE(other);
    EXPECT_LT((other->center_px - first->center_px).norm(), 0.01);
  }
}

TEST(FindScrew, SameInputGivesTheSameBits) {
  const HeadSpec head = Dressed(RandomHead(20, 5), Look::kGroove);
  const cv::Mat grey = RenderHead(head);
  const std::optional<Screw> a = Find(grey, head), b = Find(grey, head);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->center_px, b->center_px);
  EXPECT_EQ(a->covariance_px2, b->covariance_px2);
}

// Pictures of things found at a crossing that are no screw, 12 draws each.
cv::Mat Bars(std::uint32_t seed, int side) {
  Draws draws(seed);
  cv::Mat light(side, side, CV_8UC1, cv::Scalar(90));
  for (int bar = 0; bar < 2; ++bar) {
    const double angle = draws.Uniform(0, std::numbers::pi), half = draws.Uniform(0.12, 0.2) * side;
    const Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    const Vector2d middle =
        Vector2d::Constant(side / 2.0) + Vector2d(draws.Uniform(-8, 8), draws.Uniform(-8, 8));
    std::vector<cv::Point> corners;
    for (const Vector2d& p : {Vector2d(middle + side * along + half * across),
                              Vector2d(middle + side * along - half * across),
                              Vector2d(middle - side * along - half * across),
                              Vector2d(middle - side * along + half * across)}) {
      corners.emplace_back(static_cast<int>(p.x()), static_cast<int>(p.y()));
    }
    cv::fillConvexPoly(light, corners, cv::Scalar(150 + 40 * bar), cv::LINE_AA);
  }
  cv::GaussianBlur(light, light, cv::Size(5, 5), 1.0);
  cv::Mat noise(side, side, CV_8SC1);
  for (auto value = noise.begin<signed char>(); value != noise.end<signed char>(); ++value) {
    *value = static_cast<signed char>(std::lround(2 * draws.Normal()));
  }
  cv::add(light, noise, light, cv::noArray(), CV_8U);
  return light;
}

// About the middle of each.
int CountFound(const std::vector<cv::Mat>& pictures, ScrewSearch search) {
  return static_cast<int>(std::count_if(pictures.begin(), pictures.end(), [&](const cv::Mat& grey) {
    search.guess_px = {grey.cols / 2.0, grey.rows / 2.0};
    return FindScrew(grey, SrgbToneCurve(), search).has_value();
  }));
}

struct PicturesWithoutHead {
  std::vector<cv::Mat> noise, brushed, bars;
};

PicturesWithoutHead DrawWithoutHead(double radius, std::uint32_t draws) {
  PicturesWithoutHead drawn;
  for (std::uint32_t seed = 1; seed <= draws; ++seed) {
    HeadSpec plate = RandomHead(radius, seed);
    drawn.noise.push_back(RenderHead(plate));
    plate.brushed = 0.1;
    drawn.brushed.push_back(RenderHead(plate));
    drawn.bars.push_back(Bars(seed, 8 * static_cast<int>(radius)));
  }
  return drawn;
}

// In so many pictures of each kind without a head of that radius, by none of the searches.
void ExpectNoneFound(const std::vector<ScrewSearch>& searches, double radius, std::uint32_t draws) {
  const auto [noise, brushed, bars] = DrawWithoutHead(radius, draws);
  for (const ScrewSearch& search : searches) {
    EXPECT_EQ(CountFound(noise, search), 0) << "noise, radius " << radius;
    EXPECT_EQ(CountFound(brushed, search), 0) << "brushed plate, radius " << radius;
    EXPECT_EQ(CountFound(bars, search), 0) << "crossing bars, radius " << radius;
  }
}

TEST(FindScrew, SeesNoScrewWhereThereIsNone) {
  constexpr double kClear = 10;  // of half-lit rims
  for (const double radius : {8.0, 20.0, 40.0}) {
    const ScrewSearch lit = SearchAround({0, 0}, radius);
    ScrewSearch half_lit = lit;
    half_lit.half_lit = true;
    half_lit.least_evidence = kClear;
    ExpectNoneFound({lit, half_lit}, radius, 12);
  }
}

// Plate without its head in a sector of that width about the middle.
void HideSector(const HeadSpec& head, double middle_rad, double width_rad, cv::Mat* grey) {
  HeadSpec bare = head;
  bare.disc = bare.groove = bare.slot = 0;
  const cv::Mat plate = RenderHead(bare);
  const Vector2d middle(std::cos(middle_rad), std::sin(middle_rad));
  for (int y = 0; y < grey->rows; ++y) {
    for (int x = 0; x < grey->cols; ++x) {
      const Vector2d from_center = Vector2d(x, y) - head.center_px;
      const bool hidden = middle.dot(from_center) > std::cos(width_rad / 2) * from_center.norm();
      if (hidden) grey->at<uchar>(y, x) = plate.at<uchar>(y, x);
    }
  }
}

TEST(FindScrew, AHalfLitHeadIsSeenWhereOneIsAskedFor) {
  constexpr double kClear = 10, kHidden = 0.8 * std::numbers::pi;
  constexpr double kClosePx = 1, kSigmas = 4;
  int usual = 0;
  for (const Look look : {Look::kDisc, Look::kGroove, Look::kRing}) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      const HeadSpec head = Dressed(RandomHead(20, seed), look);
      cv::Mat grey = RenderHead(head);
      HideSector(head, seed, kHidden, &grey);
      ScrewSearch search = SearchAround(head.center_px + Vector2d(3, -2), 20);
      search.least_evidence = kClear;
      if (FindScrew(grey, SrgbToneCurve(), search)) ++usual;
      search.half_lit = true;
      const std::optional<Screw> screw = FindScrew(grey, SrgbToneCurve(), search);
      ASSERT_TRUE(screw) << "seed " << seed;
      const Vector2d off = screw->center_px - head.center_px;
      EXPECT_LT(off.norm(), kClosePx) << "seed " << seed;
      EXPECT_LT(off.dot(screw->covariance_px2.inverse() * off), kSigmas * kSigmas)
          << "seed " << seed;
    }
  }
  EXPECT_LE(usual, 3);
}

// A rounded tip is a rim on one side only.
TEST(FindScrew, ARoundTipIsNoScrew) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    HeadSpec head = RandomHead(20, seed);
    head.disc = 0.25;
    head.semi_minor_px = 20;
    cv::Mat grey = RenderHead(head);
    const int x = static_cast<int>(head.center_px.x());
    for (int column = x + 1; column < grey.cols; ++column) grey.col(x).copyTo(grey.col(column));
    EXPECT_FALSE(Find(grey, head)) << "seed " << seed;
  }
}

TEST(FindScrew, HardlyVisibleHeadsAreLeftAlone) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    HeadSpec head = RandomHead(20, seed);
    head.disc = 0.002;  // a quarter of the noise
    const std::optional<Screw> screw = Find(RenderHead(head), head);
    EXPECT_FALSE(screw && (screw->center_px - head.center_px).norm() > 1) << "seed " << seed;
  }
}

// Found, if its rim's evidence falls short of what is asked by that much?
bool FoundShortBy(double lacking, const HeadSpec& head) {
  const cv::Mat grey = RenderHead(head);
  ScrewSearch search = SearchAround(head.center_px, head.semi_major_px);
  search.least_evidence = 0;
  const std::optional<Screw> screw = FindScrew(grey, SrgbToneCurve(), search);
  EXPECT_TRUE(screw) << "seed " << head.seed;
  if (!screw) return false;
  search.least_evidence = screw->evidence + lacking;
  return FindScrew(grey, SrgbToneCurve(), search).has_value();
}

TEST(FindScrew, ASlotMakesUpForAFaintRimAndNothingElseDoes) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    HeadSpec head = Dressed(RandomHead(20, seed), Look::kSlotted);
    EXPECT_TRUE(FoundShortBy(1.9, head)) << "slotted, seed " << seed;
    EXPECT_FALSE(FoundShortBy(2.1, head)) << "slotted, seed " << seed;
    head.slot = 0;
    EXPECT_FALSE(FoundShortBy(0.1, head)) << "plain, seed " << seed;
  }
}

// Paper beyond two parallel lines on either side of the head.
void LayOnPaper(const HeadSpec& head, double half_width_px, double angle_rad, cv::Mat* grey) {
  constexpr double kPaper = 225, kSharpness = 2;  // grey value; of the lines, per px
  const Vector2d across(-std::sin(angle_rad), std::cos(angle_rad));
  for (int y = 0; y < grey->rows; ++y) {
    for (int x = 0; x < grey->cols; ++x) {
      const double off = std::abs(across.dot(Vector2d(x, y) - head.center_px)) - half_width_px;
      const double metal = 1 / (1 + std::exp(kSharpness * off));
      uchar& value = grey->at<uchar>(y, x);
      value = static_cast<uchar>(std::lround(metal * value + (1 - metal) * kPaper));
    }
  }
}

constexpr std::uint32_t kRings = 16;

// Of kRings thin rings of that level on a dark shank of that half width, in radii.
std::uint32_t CountRingsFound(double level, double half_width) {
  constexpr double kRadius = 16;
  constexpr std::uint32_t kFirst = 101;
  std::uint32_t found = 0;
  for (std::uint32_t seed = kFirst; seed < kFirst + kRings; ++seed) {
    HeadSpec head = RandomHead(kRadius, seed);
    head.center_px += Vector2d::Constant(22);  // room for the search on all sides
    head.side_px += 44;
    head.semi_minor_px = kRadius;
    head.plate = 0.01;
    head.groove = level;
    head.noise = 4;
    cv::Mat grey = RenderHead(head);
    LayOnPaper(head, half_width * kRadius, head.angle_rad, &grey);
    const std::optional<Screw> screw = Find(grey, head);
    if (screw && (screw->center_px - head.center_px).norm() < 0.5) ++found;
  }
  return found;
}

// The outlines of a dark shank on white paper stand out far more than the ring between them.
TEST(FindScrew, MostFaintRingsBetweenBrightEdgesAreFound) {
  EXPECT_GE(CountRingsFound(0.012, 1.5) + CountRingsFound(0.02, 1.4), 0.875 * 2 * kRings);
}

// A glossy head: a groove on one side, a glint on another, no more than another shade on the third.
cv::Mat RimUnlikeAllRound(HeadSpec head) {
  head.groove = -0.03;
  cv::Mat grey = RenderHead(head);
  head.groove = 0.08;
  const cv::Mat glint = RenderHead(head);
  head.groove = 0;
  head.disc = 0.03;
  const cv::Mat shade = RenderHead(head);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const double angle = std::atan2(y - head.center_px.y(), x - head.center_px.x());
      if (angle < -1) grey.at<uchar>(y, x) = glint.at<uchar>(y, x);
      if (angle > 1) grey.at<uchar>(y, x) = shade.at<uchar>(y, x);
    }
  }
  return grey;
}

TEST(FindScrew, MostGlossyHeadsAreFound) {
  constexpr std::uint32_t kHeads = 24, kFirst = 401;
  constexpr double kClose = 0.15;  // of the radius
  std::uint32_t found = 0;
  for (std::uint32_t seed = kFirst; seed < kFirst + kHeads; ++seed) {
    HeadSpec head = RandomHead(13, seed);
    head.semi_minor_px = head.semi_major_px;
    const std::optional<Screw> screw = Find(RimUnlikeAllRound(head), head);
    if (screw && (screw->center_px - head.center_px).norm() < kClose * head.semi_major_px) ++found;
  }
  EXPECT_GE(found, 2 * kHeads / 3);
}

ScrewSearch MagnifiedSearchAround(const Vector2d& guess, double radius) {
  ScrewSearch search = SearchAround(guess, radius);
  search.magnified = true;
  return search;
}

ScrewSearch FineSearchAround(const Vector2d& guess, double radius) {
  ScrewSearch search = SearchAround(guess, radius);
  search.fine_rims = true;
  return search;
}

struct DrawnHead {
  HeadSpec head;
  cv::Mat grey;
};

// How many are seen so close to where they are, with so much evidence.
std::uint32_t CountSeen(const std::vector<DrawnHead>& drawn,
                        ScrewSearch (*search_around)(const Vector2d&, double),
                        double close_px,
                        double evidence) {
  return static_cast<std::uint32_t>(
      std::count_if(drawn.begin(), drawn.end(), [&](const DrawnHead& d) {
        const ScrewSearch search = search_around(d.head.center_px, d.head.semi_major_px);
        const std::optional<Screw> screw = FindScrew(d.grey, SrgbToneCurve(), search);
        return screw && screw->evidence > evidence &&
               (screw->center_px - d.head.center_px).norm() < close_px;
      }));
}

// With dark slots, as of slender scissors in pictures a few hundred pixels wide.
TEST(FindScrew, SeesFarMoreSmallSlottedHeadsMagnified) {
  constexpr std::uint32_t kHeads = 40, kFirst = 501;
  constexpr double kRadiusPx = 5, kClosePx = 0.6, kEvidence = 6;
  std::vector<DrawnHead> drawn;
  for (std::uint32_t seed = kFirst; seed < kFirst + kHeads; ++seed) {
    HeadSpec head = RandomHead(kRadiusPx, seed);
    head.groove = -0.07;
    head.groove_px = 0.5;
    head.slot = -0.2;
    head.blur_px = 0.6;
    drawn.push_back({head, RenderHead(head)});
  }
  const auto magnified = CountSeen(drawn, MagnifiedSearchAround, kClosePx, kEvidence);
  EXPECT_GE(magnified, kHeads / 2);
  EXPECT_GE(magnified, 2 * CountSeen(drawn, SearchAround, kClosePx, kEvidence));
}

// Flush heads in dark shanks on white paper: a groove hardly wider than a pixel, no step, no slot.
TEST(FindScrew, SeesFarMoreLargeFlushHeadsByTheirFineRims) {
  constexpr std::uint32_t kHeads = 24, kFirst = 601;
  constexpr double kRadiusPx = 36, kClosePx = 1;
  std::vector<DrawnHead> drawn;
  for (std::uint32_t seed = kFirst; seed < kFirst + kHeads; ++seed) {
    HeadSpec head = RandomHead(kRadiusPx, seed);
    head.center_px += Vector2d::Constant(50);  // room for the search on all sides
    head.side_px += 100;
    head.semi_minor_px = kRadiusPx;
    head.plate = 0.02;
    head.groove = -0.008;
    head.groove_px = 0.4;
    head.blur_px = 0.5;
    head.noise = 1.5;
    drawn.push_back({head, RenderHead(head)});
    LayOnPaper(head, 1.5 * kRadiusPx, head.angle_rad, &drawn.back().grey);
  }
  const auto fine = CountSeen(drawn, FineSearchAround, kClosePx, kBeyondDoubt);
  EXPECT_GE(fine, kHeads / 2);
  EXPECT_GE(fine, 2 * CountSeen(drawn, SearchAround, kClosePx, kBeyondDoubt));
}

TEST(FindScrew, SeesNoFineRimWhereThereIsNone) {
  for (const double radius : {20.0, 40.0}) {
    ExpectNoneFound({FineSearchAround({0, 0}, radius)}, radius, 12);
  }
}

TEST(FindScrew, SeesNoScrewMagnifiedWhereThereIsNone) {
  for (const double radius : {5.0, 8.0}) {
    ExpectNoneFound({MagnifiedSearchAround({0, 0}, radius)}, radius, 40);
  }
}

TEST(FindScrew, OddPicturesAndPlacesGiveNothing) {
  const ToneCurve tone = SrgbToneCurve();
  const cv::Mat tiny(1, 1, CV_8UC1, cv::Scalar(7)), flat(50, 300, CV_8UC1, cv::Scalar(255));
  EXPECT_FALSE(FindScrew(tiny, tone, SearchAround({0, 0}, 10)));
  EXPECT_FALSE(FindScrew(flat, tone, SearchAround({0, 49}, 10)));
  EXPECT_FALSE(FindScrew(flat, tone, SearchAround({150, 25}, 60)));
  EXPECT_FALSE(FindScrew(flat, tone, SearchAround({-200, 900}, 10)));  // outside
}

TEST(FindScrew, AHeadAtTheBorderOfThePictureIsFound) {
  const HeadSpec head = Dressed(RandomHead(15, 2), Look::kDisc);
  const cv::Mat grey = RenderHead(head);
  const cv::Rect tight(
      static_cast<int>(head.center_px.x()) - 18, static_cast<int>(head.center_px.y()) - 18, 37, 37);
  const Vector2d corner(tight.x, tight.y);
  const std::optional<Screw> screw =
      FindScrew(grey(tight).clone(), SrgbToneCurve(), SearchAround(head.center_px - corner, 15));
  ASSERT_TRUE(screw);
  EXPECT_LT((screw->center_px + corner - head.center_px).norm(), 0.15);
}

TEST(FindScrew, ImpossibleSearchesAreNamed) {
  const ToneCurve tone = SrgbToneCurve();
  const cv::Mat grey(50, 50, CV_8UC1, cv::Scalar(0)), colour(50, 50, CV_8UC3);
  const ScrewSearch good = SearchAround({25, 25}, 8);
  EXPECT_THROW((void)FindScrew(colour, tone, good), std::invalid_argument);
  EXPECT_THROW((void)FindScrew(cv::Mat(), tone, good), std::invalid_argument);
  for (double ScrewSearch::*field :
       {&ScrewSearch::radius_px, &ScrewSearch::min_semi_axis_px, &ScrewSearch::max_semi_axis_px}) {
    for (const double value : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
      ScrewSearch bad = good;
      bad.*field = value;
      EXPECT_THROW((void)FindScrew(grey, tone, bad), std::invalid_argument) << value;
    }
  }
  ScrewSearch nowhere = good;
  nowhere.guess_px.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)FindScrew(grey, tone, nowhere), std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
