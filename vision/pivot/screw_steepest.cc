// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_steepest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/image/bilinear.h"

namespace bladecurve {
namespace {

constexpr int kDirections = 48;
// How far is looked, of the radius. Outwards to where most heads have other things about them, for
// a place that is no head has them, too.
constexpr float kInwards = 0.45F, kOutwards = 0.55F;

using AllRound = Eigen::Array<float, kDirections, 1>;  // one value a direction

// Unit vectors.
struct Directions {
  AllRound x, y;
  Directions() {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      x[i] = static_cast<float>(std::cos(angle));
      y[i] = static_cast<float>(std::sin(angle));
    }
  }
};

const Directions& Outwards() {
  static const Directions directions;
  return directions;
}

struct Circle {
  Eigen::Vector2f center;
  float radius;

  // How far off it a place may lie: a groove and a chamfer are two edges beside it.
  [[nodiscard]] float Width() const { return std::max(0.09F * radius, 1.F); }
};

// The steepest place of each direction.
struct Places {
  AllRound radius;  // its distance from the centre looked from
  AllRound clear;   // 1 where it is steeper than it is everywhere hereabouts, else 0
  float step;       // between the places looked at
};

// How much light changes on the way out, a column a direction; smoothed over neighbours.
Eigen::ArrayXXf ChangesOnTheWayOut(
    const cv::Mat& smooth, const Eigen::Vector2f& center, float first, float step, int steps) {
  Eigen::ArrayXXf light(steps + 2, kDirections);
  for (int i = 0; i < kDirections; ++i) {
    const Eigen::Vector2f outwards(Outwards().x[i], Outwards().y[i]);
    for (int k = 0; k < steps + 2; ++k) {
      const Eigen::Vector2f place = center + (first + step * static_cast<float>(k - 1)) * outwards;
      light(k, i) = static_cast<float>(Bilinear<float>(smooth, place.cast<double>()));
    }
  }
  const Eigen::ArrayXXf changes = light.bottomRows(steps) - light.topRows(steps);
  Eigen::ArrayXXf smoothed(steps, kDirections);
  for (int i = 0; i < kDirections; ++i) {
    const int before = (i + kDirections - 1) % kDirections, after = (i + 1) % kDirections;
    smoothed.col(i) =
        (0.5F * changes.col(i) + 0.25F * (changes.col(before) + changes.col(after))).abs();
  }
  return smoothed;
}

Places LookAround(const cv::Mat& smooth, const Circle& circle) {
  constexpr float kLeastStepPx = 0.5F, kMostSteps = 28;
  constexpr float kClearly = 1.5F;  // of the median change
  Places places;
  places.step = std::max(kLeastStepPx, circle.radius / kMostSteps);
  const float first = (1 - kInwards) * circle.radius;
  const int steps = 1 + static_cast<int>((kInwards + kOutwards) * circle.radius / places.step);
  Eigen::ArrayXXf changes = ChangesOnTheWayOut(smooth, circle.center, first, places.step, steps);
  AllRound most;
  for (int i = 0; i < kDirections; ++i) {
    Eigen::Index step = 0;
    most[i] = changes.col(i).maxCoeff(&step);
    places.radius[i] = first + places.step * static_cast<float>(step);
  }
  float* const median = changes.data() + changes.size() / 2;
  std::nth_element(changes.data(), median, changes.data() + changes.size());
  places.clear = (most > kClearly * *median).cast<float>();
  return places;
}

// How many of the places seen from `center` lie on a circle; the nearer, the more they count.
float PlacesOn(const Places& places, const Eigen::Vector2f& center, const Circle& circle) {
  const Eigen::Vector2f aside = circle.center - center;
  const AllRound radius = circle.radius + aside.x() * Outwards().x + aside.y() * Outwards().y;
  const AllRound off = (places.radius - radius) / circle.Width();
  return (places.clear * (1 - off.square()).max(0.F)).sum();
}

// The circle on which most of the places about another one lie.
Circle ThroughMost(const Places& places, const Circle& about) {
  constexpr int kWidths = 2;  // moved and enlarged at most
  constexpr int kRounds = 3;
  const float width = about.Width();
  Circle best = about;
  float most = PlacesOn(places, about.center, best);
  const auto improves = [&](const Circle& circle) {
    const float on = PlacesOn(places, about.center, circle);
    if (on <= most) return false;
    most = on;
    best = circle;
    return true;
  };
  const auto steps = [](int i) { return static_cast<float>(i); };
  for (int right = -kWidths; right <= kWidths; ++right) {
    for (int down = -kWidths; down <= kWidths; ++down) {
      for (int larger = -kWidths; larger <= kWidths; ++larger) {
        improves({about.center + width * Eigen::Vector2f(steps(right), steps(down)),
                  about.radius + width * steps(larger)});
      }
    }
  }
  for (const float share : {0.5F, 0.25F}) {
    bool improved = true;
    for (int round = 0; improved && round < kRounds; ++round) {
      improved = false;
      for (const float by : {-share * width, share * width}) {
        improved |= improves({best.center + Eigen::Vector2f(by, 0), best.radius});
        improved |= improves({best.center + Eigen::Vector2f(0, by), best.radius});
        improved |= improves({best.center, best.radius + by});
      }
    }
  }
  return best;
}

SteepestCircle Rated(const Circle& circle, const Places& places) {
  constexpr int kThird = kDirections / 3;
  const float width = circle.Width() + 0.5F * places.step;
  const AllRound on = places.clear * ((places.radius - circle.radius).abs() < width).cast<float>();
  float in_third = on.head<kThird>().sum();
  float least = in_third;
  for (int first = 0; first < kDirections; ++first) {
    in_third += on[(first + kThird) % kDirections] - on[first];
    least = std::min(least, in_third);
  }
  return {circle.center.cast<double>(), circle.radius, on.mean(), least / kThird};
}

}  // namespace

SteepestCircle FindSteepest(const cv::Mat& smooth,
                            const Eigen::Vector2d& center,
                            double radius_px) {
  constexpr int kLooks = 5;
  constexpr float kSamePx = 0.1F;
  constexpr float kMostChange = 0.3F;  // of the radius: beyond, it is another circle
  const Circle start{center.cast<float>(), static_cast<float>(radius_px)};
  Circle circle = start;
  SteepestCircle best{center, radius_px};
  for (int look = 0; look < kLooks; ++look) {
    const Places places = LookAround(smooth, circle);
    const SteepestCircle rated = Rated(circle, places);
    if (rated.share > best.share) best = rated;
    const Circle next = ThroughMost(places, circle);
    const auto change = [&](const Circle& from) {
      return std::max((next.center - from.center).norm(), std::abs(next.radius - from.radius));
    };
    if (change(circle) < kSamePx || change(start) > kMostChange * start.radius) break;
    circle = next;
  }
  return best;
}

}  // namespace bladecurve
