// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Accuracy and time of edge location side by side, against the Cramér-Rao bound. Not a test.
// usage: edge_benchmark [DRAWS of each straight edge; 200]
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "stopwatch.h"
#include "vision/edge/edge.h"
#include "vision/edge_bound.h"
#include "vision/edge_images.h"
#include "vision/edge_reference.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::Direction;
using testing::EdgeLook;
using testing::Gaussian;

constexpr double kLength = 300;
constexpr int kSide = 340;

// What many draws of one kind of picture say.
struct Tally {
  double sum = 0, squares = 0, normalized = 0, lost = 0, ms = 0;
  int draws = 0, refused = 0;

  // reference: error of the most that could be had from the same picture.
  void Add(double error, double sigma, double reference, double took_ms) {
    sum += error;
    squares += error * error;
    lost += (error - reference) * (error - reference);
    normalized += error * error / (sigma * sigma);
    ms += took_ms;
    ++draws;
  }
  [[nodiscard]] double Bias() const { return sum / std::max(draws, 1); }
  [[nodiscard]] double Rms() const { return std::sqrt(squares / std::max(draws, 1)); }
  // An efficient estimate is uncorrelated with every estimate of zero, hence with what another one
  // errs beyond it: bound and loss add up, without the scatter of the draws that Rms has.
  [[nodiscard]] double RmsOverBound(double bound) const {
    return std::hypot(1, std::sqrt(lost / std::max(draws, 1)) / bound);
  }
};

const double kRounding = std::sqrt(1.0 / 12);  // of a pixel and of a grey value

// Light is even over no more than that in practice; bound and reference use the pixels within. All
// there is beyond would lower the bound by a fifth.
double ReachOf(double blur_px) { return std::max(5.0, 5 * std::hypot(blur_px, kRounding)); }

// The bound over directions: which way the pixels' raster lies matters where the blur is small.
double MeanBound(double blur_px, double contrast, double noise) {
  constexpr int kDirections = 8;
  double squares = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double normal_rad = (k + 0.5) / kDirections * std::numbers::pi / 4;
    const double bound = testing::OffsetBound(
        {kLength, blur_px, contrast, std::hypot(noise, kRounding), normal_rad, ReachOf(blur_px)});
    squares += bound * bound / kDirections;
  }
  return std::sqrt(squares);
}

void LocateOnce(const EdgeLook& look, const ToneCurve& tone, Gaussian& random, Tally& tally) {
  const Vector2d normal = Direction(2 * std::numbers::pi * random.Uniform()),
                 along(-normal.y(), normal.x());
  const Vector2d center(kSide / 2, kSide / 2);
  const double offset = normal.dot(center) + random.Uniform() - 0.5;
  const cv::Mat grey = testing::Photographed(
      testing::HalfPlaneCoverage({kSide, kSide}, normal, offset, look.blur_px), look, random);
  const Vector2d middle = normal * offset + along * along.dot(center);
  EdgeGuess guess;
  guess.path_px = {middle - along * kLength / 2 + normal * 2,
                   middle + along * kLength / 2 - normal};
  guess.blade_on_left = false;
  try {
    const Stopwatch stopwatch;
    const LocatedEdge edge = LocateEdge(grey, tone, guess);
    const double ms = stopwatch.Milliseconds();
    double sum = 0, variance = 0, count = 0;
    for (const LocatedEdgePoint& point : edge.points) {
      if (!point.inlier) continue;
      sum += normal.dot(point.point_px) - offset;
      variance += point.sigma_px * point.sigma_px;
      ++count;
    }
    const double reference = testing::ReferenceError(
        grey,
        {middle, normal, kLength, look.blur_px, look.blade, look.ground, ReachOf(look.blur_px)});
    tally.Add(sum / count, std::sqrt(variance * edge.correlation_px) / count, reference, ms);
  } catch (const Refused&) {
    ++tally.refused;
  }
}

void StraightEdges(int draws) {
  std::printf(
      "Straight edges of %.0f px, any direction, linear light; rms of %d draws scatters by "
      "%.1f %%;\n"
      "expected: rms over bound without that scatter, from what is lost against maximum "
      "likelihood\n",
      kLength,
      draws,
      100 / std::sqrt(2.0 * draws));
  std::printf("%5s %9s %6s %11s %11s %7s %9s %7s %8s %8s\n",
              "blur",
              "contrast",
              "noise",
              "bias px",
              "rms px",
              "/bound",
              "expected",
              "chi2",
              "refused",
              "ms");
  std::uint32_t seed = 1;
  for (const double blur : {0.6, 1.0, 2.0}) {
    for (const double contrast : {30.0, 90.0, 200.0}) {
      for (const double noise : {0.5, 2.0, 8.0}) {
        Gaussian random(seed++);
        Tally tally;
        for (int draw = 0; draw < draws; ++draw) {
          LocateOnce({blur, 30, 30 + contrast, noise, 1}, testing::GammaCurve(1), random, tally);
        }
        const double bound = MeanBound(blur, contrast, noise);
        std::printf("%5.1f %9.0f %6.1f %+11.5f %11.5f %7.2f %9.3f %7.2f %8d %8.2f\n",
                    blur,
                    contrast,
                    noise,
                    tally.Bias(),
                    tally.Rms(),
                    tally.Rms() / bound,
                    tally.RmsOverBound(bound),
                    tally.normalized / std::max(tally.draws, 1),
                    tally.refused,
                    tally.ms / std::max(tally.draws, 1));
      }
    }
  }
}

void Circles() {
  std::printf("\nCircles, contrast 150, noise 0.5\n%7s %5s %11s\n", "radius", "blur", "bias px");
  Gaussian random(100);
  for (const double radius : {30.0, 60.0, 100.0, 400.0}) {
    for (const double blur : {0.6, 1.0, 2.0}) {
      const int side = static_cast<int>(2 * radius) + 40;
      const Vector2d center(side / 2 + random.Uniform(), side / 2 + random.Uniform());
      const cv::Mat grey =
          testing::Photographed(testing::DiskCoverage({side, side}, center, radius, blur),
                                {blur, 60, 210, 0.5, 1},
                                random);
      EdgeGuess guess;
      const double span = std::min(4.5, 800 / radius);
      for (int i = 0; i <= 200; ++i)
        guess.path_px.push_back(center + (radius + 1) * Direction(0.7 + span * i / 200));
      guess.blade_on_left = false;
      const LocatedEdge edge = LocateEdge(grey, testing::GammaCurve(1), guess);
      double sum = 0, count = 0;
      for (size_t i = 8; i + 8 < edge.points.size(); ++i, ++count)
        sum += (edge.points[i].point_px - center).norm() - radius;
      std::printf("%7.0f %5.1f %+11.5f\n", radius, blur, sum / count);
    }
  }
}

void ToneCurves() {
  constexpr int kDraws = 20;
  std::printf(
      "\nEncoded with gamma 2.2, blur 1, noise 1: curve known, and assumed to be sRGB\n%7s %7s "
      "%11s %11s\n",
      "blade",
      "ground",
      "known px",
      "sRGB px");
  for (const auto& [blade, ground] :
       {std::pair{120.0, 200.0}, std::pair{20.0, 200.0}, std::pair{200.0, 40.0}}) {
    Gaussian random(200), same(200);
    Tally known, assumed;
    for (int draw = 0; draw < kDraws; ++draw) {
      LocateOnce({1, blade, ground, 1, 2.2}, testing::GammaCurve(2.2), random, known);
      LocateOnce({1, blade, ground, 1, 2.2}, SrgbToneCurve(), same, assumed);
    }
    std::printf("%7.0f %7.0f %+11.5f %+11.5f\n", blade, ground, known.Bias(), assumed.Bias());
  }
}

void LongEdge() {
  constexpr int kRepeats = 20, kBig = 1600;
  constexpr double kLong = 1500;
  Gaussian random(300);
  const Vector2d normal = Direction(0.3), along(-normal.y(), normal.x()),
                 center(kBig / 2, kBig / 2);
  const cv::Mat grey = testing::Photographed(
      testing::HalfPlaneCoverage({kBig, kBig}, normal, normal.dot(center), 0.8),
      {0.8, 60, 180, 2, 1},
      random);
  EdgeGuess guess;
  guess.path_px = {center - along * kLong / 2 + normal * 2, center + along * kLong / 2 - normal};
  guess.blade_on_left = false;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepeats; ++i) {
    const Stopwatch stopwatch;
    (void)LocateEdge(grey, testing::GammaCurve(1), guess);
    best = std::min(best, stopwatch.Milliseconds());
  }
  std::printf("\nEdge of %.0f px: %.2f ms, best of %d\n", kLong, best, kRepeats);
}

}  // namespace
}  // namespace bladecurve

int main(int argc, char** argv) {
  constexpr int kUsualDraws = 200;
  const int draws = argc > 1 ? std::atoi(argv[1]) : kUsualDraws;
  if (argc > 2 || draws < 1) {
    std::fprintf(stderr, "usage: edge_benchmark [DRAWS of each straight edge]\n");
    return 2;
  }
  bladecurve::StraightEdges(draws);
  bladecurve::Circles();
  bladecurve::ToneCurves();
  bladecurve::LongEdge();
  return 0;
}
