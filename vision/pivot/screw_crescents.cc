// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_crescents.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::Vector2d;

constexpr int kDirections = 72;
// Of the rim's radius: what of the head and of the plate about it is looked at, and between the two
// where crescents lie.
constexpr double kHeadFrom = 0.55, kHeadTo = 0.75, kPlateFrom = 1.35, kPlateTo = 1.55;
constexpr double kCrescentFrom = 0.75, kCrescentTo = 1.3;
constexpr double kStepPx = 0.5;

// Light on the way out of a head: a row each half pixel, a column each direction.
struct Surroundings {
  double radius_px = 0;
  double step = 0;  // between rows, of the radius
  ArrayXXd light;
  ArrayXd head, plate;  // typical light of each direction

  Surroundings(const cv::Mat& picture, const RimEllipse& rim)
      : radius_px(rim.MeanRadius()), step(kStepPx / radius_px) {
    light.resize(RowsUpTo(kPlateTo), kDirections);
    for (int i = 0; i < kDirections; ++i) {
      for (Index row = 0; row < light.rows(); ++row)
        light(row, i) = Bilinear<float>(picture, rim.PointAt(At(row) * DirectionOf(i)));
    }
    head = TypicalOf(0, RowsUpTo(kHeadTo));
    plate = TypicalOf(RowsUpTo(kPlateFrom), light.rows());
  }

  [[nodiscard]] static Vector2d DirectionOf(int i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    return {std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] double At(Index row) const { return kHeadFrom + step * static_cast<double>(row); }
  [[nodiscard]] Index RowsUpTo(double to) const {
    return static_cast<Index>(std::floor((to - kHeadFrom) / step));
  }
  [[nodiscard]] double OutOfRimPx(double row) const {
    return (kHeadFrom + step * row - 1) * radius_px;
  }

 private:
  [[nodiscard]] ArrayXd TypicalOf(Index from, Index to) const {
    ArrayXd typical(kDirections);
    for (Index i = 0; i < kDirections; ++i) {
      const ArrayXd column = light.col(i).segment(from, to - from);
      typical[i] = Median({column.begin(), column.end()});
    }
    return typical;
  }
};

double MedianOf(const ArrayXd& values) { return Median({values.begin(), values.end()}); }

// Typical of the directions about one of them.
struct Sector {
  ArrayXd light;
  double head = 0, plate = 0;

  Sector(const Surroundings& around, int middle) {
    constexpr int kHalf = 4;  // directions: 20 degrees
    const auto typical = [&](const auto& value_in) {
      std::vector<double> values;
      for (int k = -kHalf; k <= kHalf; ++k)
        values.push_back(value_in((middle + k + kDirections) % kDirections));
      return Median(std::move(values));
    };
    light.resize(around.light.rows());
    for (Index row = 0; row < light.size(); ++row)
      light[row] = typical([&](int i) { return around.light(row, i); });
    head = typical([&](int i) { return around.head[i]; });
    plate = typical([&](int i) { return around.plate[i]; });
  }
};

// Of a crescent, px out of the rim.
struct Borders {
  double inner_px = 0, outer_px = 0;

  [[nodiscard]] bool RimIsOuter() const { return std::abs(outer_px) < std::abs(inner_px); }
};

// Where light, going one way from a crescent's extreme, is half way to what lies there.
double HalfWay(const Sector& sector, Index extreme, int way, double beside) {
  const double half = 0.5 * (sector.light[extreme] + beside);
  const bool falls = sector.light[extreme] > beside;
  Index row = extreme;
  while (row > 0 && row + 1 < sector.light.size() && (sector.light[row] > half) == falls)
    row += way;
  const double here = sector.light[row], before = sector.light[row - way];
  const double back = here == before ? 0 : (half - here) / (before - here);
  return static_cast<double>(row) - way * std::clamp(back, 0.0, 1.0);
}

Borders BordersAbout(const Surroundings& around, const Sector& sector, Index extreme) {
  return {around.OutOfRimPx(HalfWay(sector, extreme, -1, sector.head)),
          around.OutOfRimPx(HalfWay(sector, extreme, 1, sector.plate))};
}

struct Crescents {
  Vector2d to_light = Vector2d::Zero();  // unit
  Borders bright;
  std::optional<Borders> dark;
  double depth = 0;  // of the dark one, of the step between head and plate
};

// Of the directions, how much brighter than head and plate it is somewhere between them; than the
// plate elsewhere, too, as a groove or another blade's shadow beside the head is no plate.
ArrayXd RidgeOf(const Surroundings& around) {
  const Index from = around.RowsUpTo(kCrescentFrom), to = around.RowsUpTo(kCrescentTo);
  const ArrayXd brightest =
      around.light.middleRows(from, to - from).colwise().maxCoeff().transpose();
  return (brightest - around.head.max(around.plate).max(MedianOf(around.plate))).max(0.0);
}

// The direction about which something bright lies, if it lies to one side; of kDirections.
std::optional<int> LitDirection(const Surroundings& around) {
  constexpr double kToOneSide = 0.6;  // first harmonic over mean
  const ArrayXd ridge = RidgeOf(around);
  std::complex<double> harmonic = 0;
  for (int i = 0; i < kDirections; ++i) {
    const Vector2d direction = Surroundings::DirectionOf(i);
    harmonic += ridge[i] * std::complex(direction.x(), direction.y());
  }
  if (ridge.sum() == 0 || std::abs(harmonic) < kToOneSide * ridge.sum()) return std::nullopt;
  const double turns = std::arg(harmonic) / (2 * std::numbers::pi);
  return (static_cast<int>(std::lround(turns * kDirections)) + kDirections) % kDirections;
}

std::optional<Crescents> FindCrescents(const cv::Mat& picture, const RimEllipse& rim) {
  constexpr double kLeast = 0.015, kOfStep = 0.7;  // light
  constexpr double kOfRoom = 0.5;                  // of what is left up to white, if that is less
  constexpr double kOpposite = 0.35;               // of the height
  constexpr double kWidest = 0.28;                 // out of the rim, of its radius
  constexpr double kLeastStep = 0.02, kLeastDepth = 0.003, kLeastDeep = 0.08;
  const Surroundings around(picture, rim);
  const std::optional<int> lit = LitDirection(around);
  if (!lit) return std::nullopt;
  const double plate = MedianOf(around.plate);
  const double step = std::max(kLeastStep, std::abs(MedianOf(around.head) - plate));
  const Sector bright(around, *lit);
  Sector dark(around, (*lit + kDirections / 2) % kDirections);
  // A wide one covers part of what is looked at of the head there.
  dark.head = std::max(dark.head, MedianOf(around.head));
  const Index from = around.RowsUpTo(kCrescentFrom), count = around.RowsUpTo(kCrescentTo) - from;
  Index brightest = 0, darkest = 0;
  const double beside = std::max({bright.head, bright.plate, plate});
  const double height = bright.light.segment(from, count).maxCoeff(&brightest) - beside;
  const double opposite =
      dark.light.segment(from, count).maxCoeff() - std::max({dark.head, dark.plate, plate});
  const double least = std::max(kLeast, std::min(kOfStep * step, kOfRoom * (1 - beside)));
  if (height < least || opposite > kOpposite * height) return std::nullopt;
  Crescents found;
  found.to_light = (rim.shape * Surroundings::DirectionOf(*lit)).normalized();
  found.bright = BordersAbout(around, bright, from + brightest);
  if (found.bright.outer_px > kWidest * around.radius_px) return std::nullopt;
  const double depth =
      std::min(dark.head, dark.plate) - dark.light.segment(from, count).minCoeff(&darkest);
  if (depth > std::max(kLeastDepth, kLeastDeep * step)) {
    found.dark = BordersAbout(around, dark, from + darkest);
    found.depth = depth / step;
  }
  return found;
}

// How far the head lies from the rim's centre towards the light.
struct Lean {
  double px = 0, sigma_px = 0;
};

// The shares over ray-traced heads of 5 to 40 px and over this project's own, whose chamfers cast
// no shadow: of a rim that falls outwards both kinds lean alike; of one that rises those lean
// whose dark crescent is deep.
Lean LeanOf(const Crescents& crescents) {
  constexpr double kFalling = 0.6, kFallingSigma = 0.3;
  constexpr double kShallow = 0.2, kDeep = 0.4, kRisingSigma = 0.5;
  constexpr double kUnseen = 0.4, kUnseenSigma = 0.5;
  const bool at_outer = crescents.bright.RimIsOuter();
  if (!crescents.dark) {
    if (at_outer) return {};
    const double by_foot = 0.5 * crescents.bright.outer_px;
    return {kUnseen * by_foot, kUnseenSigma * by_foot};
  }
  if (at_outer == crescents.dark->RimIsOuter()) return {};
  const double by_top = 0.5 * (crescents.bright.inner_px - crescents.dark->inner_px);
  if (at_outer) return {kFalling * by_top, kFallingSigma * by_top};
  const double share = std::clamp((crescents.depth - kShallow) / (kDeep - kShallow), 0.0, 1.0);
  return {share * by_top, kRisingSigma * by_top};
}

}  // namespace

RimFit LeaveCrescents(const cv::Mat& light, RimFit fit) {
  const std::optional<Crescents> crescents = FindCrescents(light, fit.rim);
  if (!crescents) return fit;
  const Lean lean = LeanOf(*crescents);
  const Vector2d& to_light = crescents->to_light;
  fit.rim.center += lean.px * to_light;
  fit.center_covariance += lean.sigma_px * lean.sigma_px * to_light * to_light.transpose();
  return fit;
}

}  // namespace bladecurve
