// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_steepest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "vision/bilinear.h"
#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kDirections = 48;
// How far is looked, of the radius. Outwards to where most heads have other things about them, for
// a place that is no head has them, too.
constexpr double kInwards = 0.45, kOutwards = 0.55;
constexpr double kStepPx = 0.5;

std::array<Vector2d, kDirections> UnitVectors() {
  std::array<Vector2d, kDirections> units;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kDirections;
    units[i] = {std::cos(angle), std::sin(angle)};
  }
  return units;
}

const std::array<Vector2d, kDirections>& Directions() {
  static const std::array<Vector2d, kDirections> directions = UnitVectors();
  return directions;
}

struct Circle {
  Vector2d center;
  double radius_px;

  // How far off it a place may lie: a groove and a chamfer are two edges beside it.
  [[nodiscard]] double WidthPx() const { return std::max(0.09 * radius_px, 1.0); }
};

// The steepest place of one direction.
struct Place {
  double radius_px = 0;  // its distance from the centre looked from
  bool clear = false;    // steeper than it is everywhere hereabouts
};
using Places = std::array<Place, kDirections>;

// How much light changes on the way out, a row a direction; smoothed over neighbours.
Eigen::MatrixXd ChangesOnTheWayOut(const cv::Mat& smooth,
                                   const Vector2d& center,
                                   double first_px,
                                   int steps) {
  constexpr auto kRows = static_cast<Eigen::Index>(kDirections);
  Eigen::MatrixXd light(kRows, steps + 2);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const Vector2d& outwards = Directions()[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < light.cols(); ++k) {
      const double radius_px = first_px + kStepPx * static_cast<double>(k - 1);
      light(i, k) = Bilinear<float>(smooth, center + radius_px * outwards);
    }
  }
  const Eigen::MatrixXd changes = light.rightCols(steps) - light.leftCols(steps);
  Eigen::MatrixXd smoothed(kRows, steps);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const Eigen::Index before = (i + kRows - 1) % kRows, after = (i + 1) % kRows;
    smoothed.row(i) = 0.5 * changes.row(i) + 0.25 * (changes.row(before) + changes.row(after));
  }
  return smoothed.cwiseAbs();
}

Places LookAround(const cv::Mat& smooth, const Circle& circle) {
  constexpr double kClearly = 1.5;  // of the median change
  const double first_px = (1 - kInwards) * circle.radius_px;
  const int steps = 1 + static_cast<int>((kInwards + kOutwards) * circle.radius_px / kStepPx);
  const Eigen::MatrixXd changes = ChangesOnTheWayOut(smooth, circle.center, first_px, steps);
  const double usual = Median(std::vector<double>(changes.data(), changes.data() + changes.size()));
  Places places;
  for (std::size_t i = 0; i < kDirections; ++i) {
    Eigen::Index step = 0;
    const double most = changes.row(static_cast<Eigen::Index>(i)).maxCoeff(&step);
    places[i] = {first_px + kStepPx * static_cast<double>(step), most > kClearly * usual};
  }
  return places;
}

// How many of the places seen from `center` lie on a circle; the nearer, the more they count.
double PlacesOn(const Places& places, const Vector2d& center, const Circle& circle) {
  const double width_px = circle.WidthPx();
  double sum = 0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double radius_px =
        circle.radius_px + (circle.center - center).dot(Directions()[i]);  // seen from there
    const double off = (places[i].radius_px - radius_px) / width_px;
    if (places[i].clear) sum += std::max(0.0, 1 - off * off);
  }
  return sum;
}

// The circle on which most of the places about another one lie.
Circle ThroughMost(const Places& places, const Circle& about) {
  constexpr int kWidths = 2;  // moved and enlarged at most
  constexpr int kRounds = 3;
  const double width_px = about.WidthPx();
  Circle best = about;
  double most = PlacesOn(places, about.center, best);
  const auto improves = [&](const Circle& circle) {
    const double on = PlacesOn(places, about.center, circle);
    if (on <= most) return false;
    most = on;
    best = circle;
    return true;
  };
  for (int right = -kWidths; right <= kWidths; ++right) {
    for (int down = -kWidths; down <= kWidths; ++down) {
      for (int larger = -kWidths; larger <= kWidths; ++larger) {
        improves(
            {about.center + width_px * Vector2d(right, down), about.radius_px + width_px * larger});
      }
    }
  }
  for (const double share : {0.5, 0.25}) {
    const double step_px = share * width_px;
    bool improved = true;
    for (int round = 0; improved && round < kRounds; ++round) {
      improved = false;
      for (const double by_px : {-step_px, step_px}) {
        improved |= improves({best.center + Vector2d(by_px, 0), best.radius_px});
        improved |= improves({best.center + Vector2d(0, by_px), best.radius_px});
        improved |= improves({best.center, best.radius_px + by_px});
      }
    }
  }
  return best;
}

SteepestCircle Rated(const Circle& circle, const Places& places) {
  constexpr std::size_t kThird = kDirections / 3;
  const double width_px = circle.WidthPx() + 0.5 * kStepPx;
  std::array<bool, kDirections> on{};
  for (std::size_t i = 0; i < kDirections; ++i) {
    on[i] = places[i].clear && std::abs(places[i].radius_px - circle.radius_px) < width_px;
  }
  std::size_t least = kThird;
  for (std::size_t first = 0; first < kDirections; ++first) {
    std::size_t in_third = 0;
    for (std::size_t i = 0; i < kThird; ++i) in_third += on[(first + i) % kDirections] ? 1 : 0;
    least = std::min(least, in_third);
  }
  const auto all = static_cast<double>(std::count(on.begin(), on.end(), true));
  return {circle.center,
          circle.radius_px,
          all / kDirections,
          static_cast<double>(least) / static_cast<double>(kThird)};
}

}  // namespace

SteepestCircle FindSteepest(const cv::Mat& smooth,
                            const Eigen::Vector2d& center,
                            double radius_px) {
  constexpr int kLooks = 5;
  constexpr double kSamePx = 0.1;
  constexpr double kMostChange = 0.3;  // of the radius: beyond, it is another circle
  Circle circle{center, radius_px};
  SteepestCircle best{center, radius_px};
  for (int look = 0; look < kLooks; ++look) {
    const Places places = LookAround(smooth, circle);
    const SteepestCircle rated = Rated(circle, places);
    if (rated.share > best.share) best = rated;
    const Circle next = ThroughMost(places, circle);
    const double change_px =
        (next.center - circle.center).norm() + std::abs(next.radius_px - circle.radius_px);
    const double off_px =
        std::max((next.center - center).norm(), std::abs(next.radius_px - radius_px));
    if (change_px < kSamePx || off_px > kMostChange * radius_px) break;
    circle = next;
  }
  return best;
}

}  // namespace bladecurve
