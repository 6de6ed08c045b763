// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector2d;

// Of the rim's radius: what of the head and of the plate about it is looked at, and what between
// the two.
constexpr double kHeadFrom = 0.55, kHeadTo = 0.75, kPlateFrom = 1.35, kPlateTo = 1.55;
constexpr double kBetweenFrom = 0.75, kBetweenTo = 1.3;
constexpr double kStepPx = 0.5;

double MedianOf(const ArrayXd& values) { return Median({values.begin(), values.end()}); }

// The row where light, going one way from its extreme, is half way to what lies there.
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

}  // namespace

HeadSurroundings::HeadSurroundings(const cv::Mat& light, const RimEllipse& rim)
    : radius_px_(rim.MeanRadius()), step_(kStepPx / radius_px_) {
  light_.resize(RowsUpTo(kPlateTo), kDirections);
  for (int i = 0; i < kDirections; ++i) {
    for (Index row = 0; row < light_.rows(); ++row) {
      const double out = kHeadFrom + step_ * static_cast<double>(row);
      light_(row, i) = Bilinear<float>(light, rim.PointAt(out * DirectionOf(i)));
    }
  }
  head_ = TypicalOf(0, RowsUpTo(kHeadTo));
  plate_ = TypicalOf(RowsUpTo(kPlateFrom), light_.rows());
  typical_head_ = MedianOf(head_);
  typical_plate_ = MedianOf(plate_);
  const ArrayXd brightest =
      light_.middleRows(FirstBetween(), CountBetween()).colwise().maxCoeff().transpose();
  ridge_ = (brightest - head_.max(plate_).max(typical_plate_)).max(0.0);
}

Vector2d HeadSurroundings::DirectionOf(int i) {
  const double angle = 2 * std::numbers::pi * i / kDirections;
  return {std::cos(angle), std::sin(angle)};
}

double HeadSurroundings::OutOfRimPx(double row) const {
  return (kHeadFrom + step_ * row - 1) * radius_px_;
}

Index HeadSurroundings::FirstBetween() const { return RowsUpTo(kBetweenFrom); }

Index HeadSurroundings::CountBetween() const { return RowsUpTo(kBetweenTo) - FirstBetween(); }

double HeadSurroundings::LeastGlint(double step, double beside) {
  constexpr double kOfStep = 0.7, kOfRoom = 0.5;
  return std::min(kOfStep * step, kOfRoom * (1 - beside));
}

Index HeadSurroundings::RowsUpTo(double to) const {
  return static_cast<Index>(std::floor((to - kHeadFrom) / step_));
}

ArrayXd HeadSurroundings::TypicalOf(Index from, Index to) const {
  ArrayXd typical(kDirections);
  for (Index i = 0; i < kDirections; ++i) {
    const ArrayXd column = light_.col(i).segment(from, to - from);
    typical[i] = MedianOf(column);
  }
  return typical;
}

Sector::Sector(const HeadSurroundings& around, int middle) {
  constexpr int kAll = HeadSurroundings::kDirections;
  constexpr int kHalf = 4;  // directions: 20 degrees
  const auto typical = [&](const auto& value_in) {
    std::vector<double> values;
    for (int k = -kHalf; k <= kHalf; ++k) values.push_back(value_in((middle + k + kAll) % kAll));
    return Median(std::move(values));
  };
  light.resize(around.light().rows());
  for (Index row = 0; row < light.size(); ++row)
    light[row] = typical([&](int i) { return around.light()(row, i); });
  head = typical([&](int i) { return around.head()[i]; });
  plate = typical([&](int i) { return around.plate()[i]; });
}

bool Borders::RimIsOuter() const { return std::abs(outer_px) < std::abs(inner_px); }

Borders BordersAbout(const HeadSurroundings& around, const Sector& sector, Index extreme) {
  return {around.OutOfRimPx(HalfWay(sector, extreme, -1, sector.head)),
          around.OutOfRimPx(HalfWay(sector, extreme, 1, sector.plate))};
}

}  // namespace bladecurve
