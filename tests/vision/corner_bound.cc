// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/corner_bound.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace bladecurve {
namespace {

constexpr int kSides = 4;
// Offset and angle of each side, then:
enum Unknown { kDark = 2 * kSides, kBright, kBlur, kLampX, kLampY, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

Unknowns Truth(const SquareImage& image) {
  Unknowns truth = Unknowns::Zero();
  truth[kDark] = 255 * image.dark;
  truth[kBright] = 255 * image.bright;
  truth[kBlur] = image.blur_px;
  return truth;
}

// Distances of a point from the four sides, outside positive.
std::array<double, kSides> Distances(const SquareImage& image,
                                     const Eigen::Vector2d& point,
                                     const Unknowns& at) {
  std::array<double, kSides> distances{};
  for (int side = 0; side < kSides; ++side) {
    const double angle = image.angle_rad + side * M_PI / 2;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d along(-normal.y(), normal.x()), d = point - image.centre_px;
    distances[static_cast<size_t>(side)] =
        normal.dot(d) - 0.5 * image.side_px - at[2 * side] - at[2 * side + 1] * along.dot(d);
  }
  return distances;
}

// The pixel's box counts as a Gaussian of its variance, which is good enough for a bound.
double Light(const SquareImage& image, const Eigen::Vector2d& point, const Unknowns& at) {
  const double sigma = std::sqrt(at[kBlur] * at[kBlur] + 1.0 / 12);
  double inside = 1;
  for (const double distance : Distances(image, point, at))
    inside *= 0.5 * std::erfc(distance / sigma / std::sqrt(2.0));
  const Eigen::Vector2d place = (point - image.centre_px) / image.side_px;
  const double lamp = 1 + at[kLampX] * place.x() + at[kLampY] * place.y();
  return lamp * (at[kBright] + (at[kDark] - at[kBright]) * inside);
}

bool Used(const SquareImage& image, const Eigen::Vector2d& point) {
  constexpr double kReachBlurs = 5, kLeast = 4, kCellShare = 0.75, kCells = 6;
  const double reach =
      std::min(std::max(kReachBlurs * std::sqrt(image.blur_px * image.blur_px + 1.0 / 12), kLeast),
               kCellShare * image.side_px / kCells);
  const auto distances = Distances(image, point, Truth(image));
  return std::abs(*std::max_element(distances.begin(), distances.end())) <= reach;
}

Unknowns Gradient(const SquareImage& image, const Eigen::Vector2d& point) {
  constexpr double kStep = 1e-5;
  Unknowns gradient;
  for (int k = 0; k < kUnknowns; ++k) {
    Unknowns more = Truth(image), less = more;
    more[k] += kStep;
    less[k] -= kStep;
    gradient[k] = (Light(image, point, more) - Light(image, point, less)) / (2 * kStep);
  }
  return gradient;
}

}  // namespace

double CornerBound(const SquareImage& image) {
  Information information = Information::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!Used(image, Eigen::Vector2d(x, y))) continue;
      const Unknowns gradient = Gradient(image, Eigen::Vector2d(x, y));
      information += gradient * gradient.transpose();
    }
  }
  const double rounding = 1.0 / 12;
  const Information covariance =
      (image.noise * image.noise + rounding) * information.ldlt().solve(Information::Identity());
  // A corner moves across a side by what the side does at its end.
  double variance = 0;
  for (int side = 0; side < kSides; ++side) {
    const Eigen::Matrix2d own = covariance.block<2, 2>(2 * side, 2 * side);
    for (const double end : {-0.5, 0.5}) {
      const Eigen::Vector2d lever(1, end * image.side_px);
      variance += lever.dot(own * lever) / (2 * kSides);
    }
  }
  return std::sqrt(variance);
}

}  // namespace bladecurve
