// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/corner_bound.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace bladecurve {
namespace {

constexpr int kCorners = 8;  // coordinates
enum Unknown { kDark = kCorners, kBright, kBlur, kLampX, kLampY, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

Unknowns Truth(const SquareImage& image) {
  Unknowns truth = Unknowns::Zero();
  const auto corners = Corners(image);
  for (int k = 0; k < 4; ++k) truth.segment<2>(2 * k) = corners[static_cast<size_t>(k)];
  truth[kDark] = 255 * image.dark;
  truth[kBright] = 255 * image.bright;
  truth[kBlur] = image.blur_px;
  return truth;
}

// A place of the picture in sides from the middle of the square with these corners.
class InSquare {
 public:
  explicit InSquare(const Unknowns& at) {
    Eigen::Matrix<double, 8, 8> equations;
    Eigen::Matrix<double, 8, 1> sides;
    for (int k = 0; k < 4; ++k) {
      const double x = at[2 * k], y = at[2 * k + 1];
      const double u = k == 1 || k == 2 ? 0.5 : -0.5, v = k >= 2 ? 0.5 : -0.5;
      equations.row(2 * k) << x, y, 1, 0, 0, 0, -u * x, -u * y;
      equations.row(2 * k + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
      sides.segment<2>(2 * k) << u, v;
    }
    const Eigen::Matrix<double, 8, 1> h = equations.fullPivLu().solve(sides);
    map_ << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  }

  [[nodiscard]] Eigen::Vector2d At(const Eigen::Vector2d& point) const {
    return (map_ * point.homogeneous()).hnormalized();
  }

 private:
  Eigen::Matrix3d map_;
};

double Light(const SquareImage& image,
             const InSquare& square,
             const Eigen::Vector2d& point,
             const Unknowns& at) {
  const Eigen::Vector2d place = square.At(point);
  const double inside = Inside(image, place, std::sqrt(at[kBlur] * at[kBlur] + 1.0 / 12));
  const double lamp = 1 + at[kLampX] * place.x() + at[kLampY] * place.y();
  return lamp * (at[kBright] + (at[kDark] - at[kBright]) * inside);
}

// The truth with one unknown a little more and a little less.
struct Nudged {
  Nudged(const Unknowns& truth, int unknown, double step)
      : more(truth + step * Unknowns::Unit(unknown)),
        less(truth - step * Unknowns::Unit(unknown)),
        square_more(more),
        square_less(less) {}

  Unknowns more, less;
  InSquare square_more, square_less;
};

}  // namespace

double CornerBound(const SquareImage& image) {
  constexpr double kStep = 1e-4;
  std::vector<Nudged> nudged;
  for (int k = 0; k < kUnknowns; ++k) nudged.emplace_back(Truth(image), k, kStep);
  Information information = Information::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      Unknowns gradient;
      for (int k = 0; k < kUnknowns; ++k) {
        const Nudged& by = nudged[static_cast<size_t>(k)];
        gradient[k] = (Light(image, by.square_more, {x, y}, by.more) -
                       Light(image, by.square_less, {x, y}, by.less)) /
                      (2 * kStep);
      }
      information += gradient * gradient.transpose();
    }
  }
  const double rounding = 1.0 / 12;
  const Information covariance =
      (image.noise * image.noise + rounding) * information.ldlt().solve(Information::Identity());
  return std::sqrt(covariance.topLeftCorner<kCorners, kCorners>().trace() / kCorners);
}

}  // namespace bladecurve
