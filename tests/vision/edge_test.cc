// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "vision/edge/edge_fit.h"
#include "vision/edge_bound.h"
#include "vision/edge_images.h"
#include "vision/edge_reference.h"
#include "vision/image/robust_statistics.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Direction;
using testing::EdgeLook;
using testing::Gaussian;
using testing::Smooth;

constexpr int kSide = 240;
constexpr double kEdgeLength = 180;

// A straight edge through the middle of a picture; background is where normal . p > offset.
struct Line {
  Vector2d normal;
  double offset = 0;

  [[nodiscard]] double Distance(const Vector2d& p) const { return normal.dot(p) - offset; }
};

Line RandomLine(Gaussian& random) {
  const Vector2d normal = Direction(2 * std::numbers::pi * random.Uniform());
  return {normal, normal.dot(Vector2d(kSide / 2, kSide / 2)) + random.Uniform() - 0.5};
}

// A guess that is off by `start_px` and `end_px` at its ends.
EdgeGuess GuessOf(const Line& line, double start_px, double end_px) {
  const Vector2d along(-line.normal.y(), line.normal.x());
  const Vector2d middle =
      line.normal * line.offset + along * along.dot(Vector2d(kSide / 2, kSide / 2));
  EdgeGuess guess;
  guess.path_px = {middle - along * kEdgeLength / 2 + line.normal * start_px,
                   middle + along * kEdgeLength / 2 + line.normal * end_px};
  guess.blade_on_left = false;  // left of (-ny, nx) is (nx, ny): background
  return guess;
}

struct Offset {
  double mean = 0, sigma = 0;
};

Offset MeanOffset(const LocatedEdge& edge, const Line& line) {
  double sum = 0, variance = 0, count = 0;
  for (const LocatedEdgePoint& point : edge.points) {
    if (!point.inlier) continue;
    sum += line.Distance(point.point_px);
    variance += point.sigma_px * point.sigma_px;
    ++count;
  }
  return {sum / count, std::sqrt(variance * edge.correlation_px) / count};
}

cv::Mat PhotographOf(const Line& line, const EdgeLook& look, Gaussian& random) {
  const cv::Mat coverage =
      testing::HalfPlaneCoverage({kSide, kSide}, line.normal, line.offset, look.blur_px);
  return testing::Photographed(coverage, look, random);
}

TEST(LocateEdge, StraightEdgesOfAnyDirectionHaveNoBiasAndAnHonestSigma) {
  constexpr int kTrials = 60;
  Gaussian random(11);
  const EdgeLook look{0.9, 60, 180, 2, 1};
  double sum = 0, squares = 0, normalized = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, look, random);
    const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 2.5, -2));
    const Offset offset = MeanOffset(edge, line);
    sum += offset.mean;
    squares += offset.mean * offset.mean;
    normalized += std::pow(offset.mean / offset.sigma, 2);
  }
  const double bound = testing::OffsetBound(
      {kEdgeLength, look.blur_px, 120, std::hypot(2, std::sqrt(1.0 / 12)), 0.4, 5});
  const double rms = std::sqrt(squares / kTrials);
  // rms of 60 draws scatters by 9 %; bias by rms / sqrt(60).
  EXPECT_LT(rms, 1.25 * bound) << "bound " << bound;
  EXPECT_LT(std::abs(sum / kTrials), std::max(0.001, 3.5 * rms / std::sqrt(kTrials)));
  EXPECT_GT(normalized / kTrials, 0.5);
  EXPECT_LT(normalized / kTrials, 1.6);
}

TEST(LocateEdge, NoiseAQuarterOfTheStepLosesLittleOfTheInformation) {
  constexpr int kTrials = 60;
  Gaussian random(21);
  const EdgeLook look{1, 30, 60, 8, 1};
  const double reach = 5 * std::hypot(look.blur_px, std::sqrt(1.0 / 12));
  std::vector<double> lost;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, look, random);
    const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 2.5, -2));
    const Vector2d center(kSide / 2, kSide / 2);
    const Vector2d middle = center + (line.offset - line.normal.dot(center)) * line.normal;
    const double reference = testing::ReferenceError(
        grey, {middle, line.normal, kEdgeLength, look.blur_px, look.blade, look.ground, reach});
    lost.push_back(MeanOffset(edge, line).mean - reference);
  }
  const double bound = testing::OffsetBound(
      {kEdgeLength, look.blur_px, 30, std::hypot(8, std::sqrt(1.0 / 12)), 0.4, reach});
  // Half of the draws lose less than a third of the bound; a line begun on noise loses more than
  // all.
  EXPECT_LT(MedianAbsolute(lost), bound / 3);
}

// More points tell where a noisy edge runs than where a clear one does.
TEST(LocateEdge, TheTrendOfANoisyEdgeIsTakenFromMoreOfIt) {
  constexpr int kTrials = 30;
  constexpr double kMostPx = 0.19;  // 60 px of it tell it to 0.21
  Gaussian random(23);
  const EdgeLook look{1, 30, 60, 16, 1};
  double squares = 0, count = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, look, random);
    const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 2.5, -2));
    const double mean = MeanOffset(edge, line).mean;
    for (const LocatedEdgePoint& p : edge.points) {
      if (!p.inlier) continue;
      squares += std::pow(line.normal.dot(p.trend_px) - line.offset - mean, 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), kMostPx);
}

// Followed from peak to peak of the noise, a soft edge is lost along a stretch in one picture of
// fifteen, which makes the rms four times the bound; one in sixty would leave 1.4.
TEST(LocateEdge, NoiseDoesNotLeadASoftEdgeAstray) {
  constexpr int kTrials = 60;
  constexpr double kAstray = 2;
  Gaussian random(22);
  const EdgeLook look{2, 30, 60, 8, 1};
  const double bound = testing::OffsetBound(
      {kEdgeLength, look.blur_px, 30, std::hypot(8, std::sqrt(1.0 / 12)), 0.4, 5 * look.blur_px});
  double squares = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, look, random);
    const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 2.5, -2));
    squares += std::pow(MeanOffset(edge, line).mean, 2);
  }
  EXPECT_LT(std::sqrt(squares / kTrials), kAstray * bound) << "bound " << bound;
}

TEST(LocateEdge, CurvedEdgesAreFreeOfTheBlursBias) {
  constexpr double kBias = 0.005;
  Gaussian random(12);
  for (const double radius : {30.0, 100.0}) {
    for (const double blur : {0.6, 1.0, 2.0}) {
      const int side = static_cast<int>(2 * radius) + 40;
      const Vector2d center(side / 2 + random.Uniform(), side / 2 + random.Uniform());
      const cv::Mat grey =
          testing::Photographed(testing::DiskCoverage({side, side}, center, radius, blur),
                                {blur, 60, 210, 0.4, 1},
                                random);
      EdgeGuess guess;
      for (int i = 0; i <= 100; ++i)
        guess.path_px.push_back(center + (radius + 1) * Direction(0.7 + 0.045 * i));
      guess.blade_on_left = false;
      const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), guess);
      double sum = 0, count = 0;
      for (size_t i = 8; i + 8 < edge.points.size(); ++i, ++count)
        sum += (edge.points[i].point_px - center).norm() - radius;
      EXPECT_NEAR(sum / count, 0, kBias) << "radius " << radius << " blur " << blur;
      EXPECT_NEAR(edge.blur_px, blur, 0.03);
    }
  }
}

TEST(LocateEdge, ReversingThePathChangesNothing) {
  constexpr double kOtherSamples = 0.5;  // sigmas; samples and stretches fall elsewhere
  Gaussian random(13);
  const Line line = RandomLine(random);
  const cv::Mat grey = testing::Photographed(
      testing::HalfPlaneCoverage({kSide, kSide}, line.normal, line.offset, 0.8),
      {0.8, 200, 60, 2, 1},
      random);
  EdgeGuess guess = GuessOf(line, 1.5, 1.5);
  const Offset there = MeanOffset(LocateEdge(grey, testing::GammaCurve(1), guess), line);
  std::reverse(guess.path_px.begin(), guess.path_px.end());
  guess.blade_on_left = true;
  const Offset back = MeanOffset(LocateEdge(grey, testing::GammaCurve(1), guess), line);
  EXPECT_NEAR(there.mean, back.mean, kOtherSamples * there.sigma);
}

TEST(LocateEdge, EncodedPicturesNeedTheirToneCurve) {
  constexpr double kKnown = 0.01;
  Gaussian random(14);
  const Line line = RandomLine(random);
  const EdgeLook look{1.0, 20, 200, 1, 2.2};
  const cv::Mat grey = PhotographOf(line, look, random);
  const Offset known =
      MeanOffset(LocateEdge(grey, testing::GammaCurve(2.2), GuessOf(line, 1, -1)), line);
  EXPECT_LT(std::abs(known.mean), kKnown);
  const LocatedEdge assumed = LocateEdge(grey, SrgbToneCurve(), GuessOf(line, 1, -1));
  EXPECT_LT(std::abs(MeanOffset(assumed, line).mean), 0.03);
  EXPECT_GT(assumed.common_sigma_px, 0.3 * std::abs(MeanOffset(assumed, line).mean));
  EXPECT_GT(
      std::abs(
          MeanOffset(LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 1, -1)), line).mean),
      0.2);
}

// Light as a function of the distance from the blade's border.
template <typename Function>
cv::Mat Banded(const Line& line, const Function& light) {
  cv::Mat picture(kSide, kSide, CV_64F);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) picture.at<double>(y, x) = light(line.Distance(Vector2d(x, y)));
  }
  return picture;
}

// Blur and pixel box together, as a Gaussian of the same variance: good to 0.003 px, which is all
// these ask.
double Edge(double d) { return Smooth(d, std::hypot(0.7, std::sqrt(1.0 / 12))); }

TEST(LocateEdge, TheBordersOfASoftShadowIsNotTheBlades) {
  Gaussian random(15);
  for (int trial = 0; trial < 8; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light =
        Banded(line, [](double d) { return 90 + Edge(d) * (-40 + 140 * Smooth(d - 7, 2.5)); });
    const LocatedEdge edge = LocateEdge(
        testing::Stored(light, 1.5, 1, random), testing::GammaCurve(1), GuessOf(line, 2, 4));
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, 0.15);  // the shadow is no parabola
    EXPECT_LT(std::abs(MeanOffset(edge, line).mean), 2 * edge.common_sigma_px);
  }
}

// Seen through Edge()'s blur, by summation.
template <typename Function>
double Blurred(double d, const Function& light) {
  constexpr double kStep = 0.02, kReach = 4;  // px
  const double variance = 0.7 * 0.7 + 1.0 / 12;
  double sum = 0, weights = 0;
  for (double u = -kReach; u <= kReach; u += kStep) {
    const double weight = std::exp(-0.5 * u * u / variance);
    sum += weight * light(d - u);
    weights += weight;
  }
  return sum / weights;
}

// Deepest at the blade, gone within a few px: steepest where the edge is.
TEST(LocateEdge, AContactShadowIsNoBlurOnceThatIsBounded) {
  constexpr double kBlur = 0.7;    // of Edge()
  constexpr double kClose = 0.06;  // px
  Gaussian random(23);
  double alone = 0, bounded = 0;
  constexpr int kTrials = 6;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light = Banded(line, [](double d) {
      return Blurred(d, [](double u) { return u < 0 ? 40.0 : 140 - 60 * std::exp(-u / 3); });
    });
    const cv::Mat grey = testing::Stored(light, 1.5, 1, random);
    const auto mean = [&](const EdgeOptions& options) {
      return MeanOffset(LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 1, -1), options),
                        line)
          .mean;
    };
    EdgeOptions options;
    alone += mean(options) / kTrials;
    options.most_blur_px = kBlur;
    bounded += mean(options) / kTrials;
  }
  EXPECT_NEAR(bounded, 0, kClose);
  EXPECT_GT(alone, 1.5 * std::abs(bounded));
}

// A blade nearer to the camera may be less sharp than the print that bounds its blur.
TEST(LocateEdge, ABoundBelowTheTrueBlurMovesNoPlainEdge) {
  constexpr double kClose = 0.02;  // px
  Gaussian random(24);
  const EdgeLook look{1.2, 60, 180, 1.5, 1};
  for (int trial = 0; trial < 6; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, look, random);
    EdgeOptions options;
    options.most_blur_px = 0.7;
    const LocatedEdge edge =
        LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 1, -1), options);
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, kClose);
  }
}

// Unless the caller knows that nothing in the picture is that soft.
// Fringes of compression look like sharper steps than a lens makes.
TEST(FitEdge, ABlurExpectedFarTooSmallMovesNoPlainEdge) {
  constexpr double kExpected = 0.4, kBlur = 1.02, kClose = 0.01;
  Gaussian random(33);
  for (int trial = 0; trial < 5; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat grey = PhotographOf(line, {kBlur, 7, 215, 0.6, 2.2}, random);
    const EdgeGuess guess = GuessOf(line, 0.5, 0.5);
    EdgeFitOptions options;
    options.blur_px = kExpected;
    const EdgeFit fit =
        FitEdge(grey, testing::GammaCurve(2.2), guess.path_px, guess.blade_on_left, options);
    double offset = 0;
    for (const EdgeSlice& slice : fit.slices) {
      const auto sample = static_cast<size_t>(slice.sample);
      offset += slice.offset_px + line.Distance(fit.path.points[sample]);
    }
    EXPECT_NEAR(offset / static_cast<double>(fit.slices.size()), 0, kClose) << "trial " << trial;
    EXPECT_NEAR(fit.blur_px, kBlur, 0.02) << "trial " << trial;
  }
}

TEST(LocateEdge, AFirmBoundOfTheBlurHolds) {
  Gaussian random(25);
  const EdgeLook look{1.2, 60, 180, 1.5, 1};
  const Line line = RandomLine(random);
  const cv::Mat grey = PhotographOf(line, look, random);
  EdgeOptions options;
  options.most_blur_px = 0.7;
  options.may_be_softer = false;
  const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 1, -1), options);
  EXPECT_LE(edge.blur_px, options.most_blur_px);
  options.may_be_softer = true;
  EXPECT_GT(LocateEdge(grey, testing::GammaCurve(1), GuessOf(line, 1, -1), options).blur_px,
            options.most_blur_px);
}

TEST(LocateEdge, ADarkBevelLineBelongsToTheBlade) {
  constexpr double kOverlap = 0.25;  // px; the blurs of two borders 3 px apart overlap
  Gaussian random(16);
  for (int trial = 0; trial < 8; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light =
        Banded(line, [](double d) { return 190 - 150 * Edge(d + 3) + 80 * Edge(d); });
    const LocatedEdge edge = LocateEdge(
        testing::Stored(light, 1.5, 1, random), testing::GammaCurve(1), GuessOf(line, -3, 1));
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, kOverlap);
  }
}

// A blade two and a half times brighter than white, as the picture stores it: cut off.
TEST(LocateEdge, AGlaringBladesEdgeIsFoundOnceTheBlurIsKnown) {
  constexpr double kBlur = 0.7;     // of Edge()
  constexpr double kClose = 0.12;   // px; the light beyond white is known to a factor only
  constexpr double kPulled = 0.35;  // px; what is taken for half-way lies outwards
  Gaussian random(21);
  for (int trial = 0; trial < 6; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light = Banded(line, [](double d) { return 640 - 610 * Edge(d); });
    const cv::Mat grey = testing::Stored(light, 1.5, 2.2, random);
    const LocatedEdge alone = LocateEdge(grey, testing::GammaCurve(2.2), GuessOf(line, 1, -1));
    EXPECT_GT(alone.overexposed, 0.9);
    EXPECT_GT(MeanOffset(alone, line).mean, kPulled);
    EXPECT_GT(alone.common_sigma_px, 0.5 * MeanOffset(alone, line).mean) << "and says so";
    EdgeOptions options;
    options.blur_px = kBlur;
    const LocatedEdge tied =
        LocateEdge(grey, testing::GammaCurve(2.2), GuessOf(line, 1, -1), options);
    EXPECT_NEAR(MeanOffset(tied, line).mean, 0, kClose);
  }
}

// A bevel's inner border may look sharper than the blade's, which a lens out of focus softens.
TEST(LocateEdge, TheDeeperFallOfLightIsTheBorderHoweverSoft) {
  constexpr double kClose = 0.1;  // px
  Gaussian random(22);
  for (int trial = 0; trial < 6; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light =
        Banded(line, [](double d) { return 200 - 60 * Smooth(d + 7, 0.5) - 125 * Smooth(d, 1.4); });
    const LocatedEdge edge = LocateEdge(
        testing::Stored(light, 1.5, 2.2, random), testing::GammaCurve(2.2), GuessOf(line, -4, -2));
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, kClose);
  }
}

// Scene finding may have seen the bright part of the blade only: it guesses further off the border
// than it takes borders to lie.
TEST(LocateEdge, WhereLightFallsTwiceTheOuterFallIsTheBorderHoweverFarFromTheGuess) {
  constexpr double kClose = 0.05;             // px
  constexpr double kBevel = 7, kGuess = -11;  // px
  Gaussian random(23);
  for (int trial = 0; trial < 6; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light =
        Banded(line, [](double d) { return 200 - 90 * Edge(d + kBevel) - 60 * Edge(d); });
    const LocatedEdge edge = LocateEdge(testing::Stored(light, 1.5, 1, random),
                                        testing::GammaCurve(1),
                                        GuessOf(line, kGuess, kGuess));
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, kClose);
  }
}

// A bevel may mirror the ground, and be hardly brighter than the soft shadow beside it.
TEST(LocateEdge, AnOuterFallOfLightIsTheBorderHoweverLow) {
  constexpr double kClose = 0.3;                        // px; the shadow draws it out
  constexpr double kBevel = 6, kShadow = 12;            // px wide, and to where it is half as deep
  constexpr double kFlat = 240, kLow = 14, kDeep = 24;  // what light steps by
  Gaussian random(24);
  for (int trial = 0; trial < 6; ++trial) {
    const Line line = RandomLine(random);
    const cv::Mat light = Banded(line, [](double d) {
      return kFlat - 165 * Edge(d + kBevel) - kLow * Edge(d) + kDeep * Smooth(d - kShadow, 4);
    });
    const LocatedEdge edge = LocateEdge(testing::Stored(light, 0.5, 1, random),
                                        testing::GammaCurve(1),
                                        GuessOf(line, -kBevel, -kBevel));
    EXPECT_NEAR(MeanOffset(edge, line).mean, 0, kClose);
  }
}

TEST(LocateEdge, GlintsAreOutliersAndMoveNothing) {
  Gaussian random(17);
  const Line line = RandomLine(random);
  cv::Mat light = Banded(line, [](double d) { return 70 + 90 * Edge(d); });
  const Vector2d along(-line.normal.y(), line.normal.x());
  const Vector2d middle =
      line.normal * line.offset + along * along.dot(Vector2d(kSide / 2, kSide / 2));
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if ((Vector2d(x, y) - middle).norm() < 5) light.at<double>(y, x) = 250;
    }
  }
  const LocatedEdge edge =
      LocateEdge(testing::Stored(light, 1, 1, random), testing::GammaCurve(1), GuessOf(line, 1, 1));
  EXPECT_NEAR(MeanOffset(edge, line).mean, 0, 0.03);
  EXPECT_TRUE(std::any_of(
      edge.points.begin(), edge.points.end(), [](const LocatedEdgePoint& p) { return !p.inlier; }));
}

Reason RefusalOf(const cv::Mat& grey, const EdgeGuess& guess, const EdgeOptions& options = {}) {
  try {
    (void)LocateEdge(grey, testing::GammaCurve(1), guess, options);
  } catch (const Refused& refused) {
    return refused.reason();
  }
  ADD_FAILURE() << "nothing was refused";
  return Reason::kUnreadable;
}

TEST(LocateEdge, RefusesWhatHasNoEdge) {
  Gaussian random(18);
  const Line line = RandomLine(random);
  const cv::Mat blank(kSide, kSide, CV_64F, cv::Scalar(120));
  EXPECT_EQ(RefusalOf(testing::Stored(blank, 0, 1, random), GuessOf(line, 0, 0)),
            Reason::kLowContrast);
  EXPECT_EQ(RefusalOf(testing::Stored(blank, 3, 1, random), GuessOf(line, 0, 0)),
            Reason::kLowContrast);
}

TEST(LocateEdge, TellsBlurFromWantOfContrast) {
  Gaussian random(18);
  const Line line = RandomLine(random);
  const auto reason = [&](const std::function<double(double)>& light) {
    return RefusalOf(testing::Stored(Banded(line, light), 1, 1, random), GuessOf(line, 0, 0));
  };
  for (const double blur_px : {6, 9, 12})
    EXPECT_EQ(reason([=](double d) { return 60 + 120 * Smooth(d, blur_px); }), Reason::kBlurred);
  EdgeOptions beside_sharp_print;
  beside_sharp_print.most_blur_px = 0.9;
  const cv::Mat blurred = Banded(line, [](double d) { return 60 + 120 * Smooth(d, 9); });
  EXPECT_EQ(
      RefusalOf(testing::Stored(blurred, 1, 1, random), GuessOf(line, 0, 0), beside_sharp_print),
      Reason::kLowContrast)
      << "a shadow's border";
  EXPECT_EQ(reason([](double d) { return 120 + d; }), Reason::kLowContrast)
      << "light that falls off";
  for (const double aside_px : {7, 9, 11}) {
    EXPECT_EQ(reason([=](double d) { return 60 + 120 * Smooth(d - aside_px, 0.8); }),
              Reason::kLowContrast)
        << "a sharp step too far aside to be the edge";
  }
}

TEST(LocateEdge, RefusesWhatIsTooShort) {
  const cv::Mat grey(kSide, kSide, CV_8U, cv::Scalar(120));
  EdgeGuess guess;
  guess.path_px = {Vector2d(50, 50), Vector2d(56, 50)};
  EXPECT_EQ(RefusalOf(grey, guess), Reason::kEdgeTooShort);
}

TEST(LocateEdge, NamesImpossibleArguments) {
  const cv::Mat grey(kSide, kSide, CV_8U, cv::Scalar(120));
  EdgeGuess guess;
  guess.path_px = {Vector2d(50, 50), Vector2d(150, 50)};
  EXPECT_THROW((void)LocateEdge(cv::Mat(), SrgbToneCurve(), guess), std::invalid_argument);
  EXPECT_THROW((void)LocateEdge(grey, SrgbToneCurve(), {}), std::invalid_argument);
  guess.search_px = -1;
  EXPECT_THROW((void)LocateEdge(grey, SrgbToneCurve(), guess), std::invalid_argument);
}

TEST(LocateEdge, APathThatLeavesThePictureIsNoCrash) {
  Gaussian random(19);
  const Line line{Vector2d(0, 1), 100.3};
  const cv::Mat grey = testing::Photographed(
      testing::HalfPlaneCoverage({kSide, kSide}, line.normal, line.offset, 0.8),
      {0.8, 60, 180, 2, 1},
      random);
  EdgeGuess guess;
  guess.path_px = {Vector2d(-60, 101), Vector2d(kSide + 60, 99)};
  guess.blade_on_left = true;
  const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), guess);
  EXPECT_NEAR(MeanOffset(edge, line).mean, 0, 0.03);
}

}  // namespace
}  // namespace bladecurve
