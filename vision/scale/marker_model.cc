// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/image/blurred_step.h"
#include "vision/scale/marker_detector.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kComplete = 6;  // sigmas from a step to where it lacks less than 1e-9

// The columns (or rows) that a pixel sees: the share of each, and how it changes per cell of the
// pixel's place and per cell of sigma.
struct AxisShares {
  AxisShares(double place, double sigma) {
    const double per_sigma = 1 / sigma, reach = kComplete * sigma;
    begin = static_cast<int>(std::clamp(place - reach, 0.0, double{kMarkerCells}));
    end = static_cast<int>(std::ceil(std::clamp(place + reach, 0.0, double{kMarkerCells})));
    Line left = LineAt((place - begin) * per_sigma, per_sigma);
    for (int cell = begin; cell < end; ++cell) {
      const Line right = LineAt((place - cell - 1) * per_sigma, per_sigma);
      const auto i = static_cast<size_t>(cell);
      share[i] = left.passed - right.passed;
      slope[i] = left.slope - right.slope;
      softening[i] = left.softening - right.softening;
      left = right;
    }
  }

  int begin, end;
  std::array<double, kMarkerCells> share{}, slope{}, softening{};

 private:
  struct Line {
    double passed, slope, softening;
  };
  static Line LineAt(double z, double per_sigma) {
    if (z > kComplete) return {1, 0, 0};
    if (z < -kComplete) return {0, 0, 0};
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi) * per_sigma;
    return {0.5 * std::erfc(-z / std::numbers::sqrt2), density, -z * density};
  }
};

// Share of ink, and per cell along u and v, and per cell of sigma along either.
struct InkSeen {
  double share = 0, along_u = 0, along_v = 0, softening_u = 0, softening_v = 0;
};

InkSeen Seen(const InkCells& ink, const AxisShares& columns, const AxisShares& rows) {
  InkSeen seen;
  for (int row = rows.begin; row < rows.end; ++row) {
    const auto j = static_cast<size_t>(row);
    double share = 0, slope = 0, softening = 0;
    for (int column = columns.begin; column < columns.end; ++column) {
      const auto i = static_cast<size_t>(column);
      if (!ink[j][i]) continue;
      share += columns.share[i];
      slope += columns.slope[i];
      softening += columns.softening[i];
    }
    seen.share += rows.share[j] * share;
    seen.along_u += rows.share[j] * slope;
    seen.along_v += rows.slope[j] * share;
    seen.softening_u += rows.share[j] * softening;
    seen.softening_v += rows.softening[j] * share;
  }
  return seen;
}

// Column or row of a place; -1 and 6 are the paper outside.
int CellAt(double cell) {
  return static_cast<int>(std::clamp(cell + 1, 0.0, kMarkerCells + 1.0)) - 1;
}

bool HasInk(const InkCells& ink, int row, int column) {
  return row >= 0 && row < kMarkerCells && column >= 0 && column < kMarkerCells &&
         ink[static_cast<size_t>(row)][static_cast<size_t>(column)];
}

}  // namespace

InkCells InkCellsOf(int id) {
  constexpr int kPattern = kMarkerCells - 2;
  const std::array<bool, kPattern* kPattern> paper = MarkerCells(id);
  InkCells ink;
  for (auto& row : ink) row.fill(true);
  for (size_t i = 0; i < paper.size(); ++i) ink[i / kPattern + 1][i % kPattern + 1] = !paper[i];
  return ink;
}

Vector2d CornerInCells(int corner) {
  return kMarkerCells * Vector2d(corner == 1 || corner == 2, corner >= 2);
}

MarkerCorner CornerOf(const MarkerVector& at, int corner) {
  const Vector2d cells = CornerInCells(corner);
  const double u = cells.x(), v = cells.y();
  Eigen::Matrix2d forward;
  forward << at[0] - u * at[6], at[1] - u * at[7], at[3] - v * at[6], at[4] - v * at[7];
  const Eigen::Matrix2d back = forward.inverse();
  MarkerCorner found;
  found.place = back * Vector2d(u - at[2], v - at[5]);
  const double x = found.place.x(), y = found.place.y();
  Eigen::Matrix<double, 2, kHomography> change;
  change << x, y, 1, 0, 0, 0, -u * x, -u * y, 0, 0, 0, x, y, 1, -v * x, -v * y;
  found.jacobian = -back * change;
  return found;
}

MarkerModel::MarkerModel(const InkCells& ink, const MarkerFrame& frame, const MarkerVector& at)
    : ink_(ink),
      at_(at),
      total_blur_px_(std::sqrt(TotalBlurVariance(at[kBlur]))),
      sigma_(total_blur_px_ / frame.cell_px) {}

Vector2d MarkerModel::InCells(const Vector2d& place) const {
  const double x = place.x(), y = place.y(), per_w = 1 / (at_[6] * x + at_[7] * y + 1);
  return {(at_[0] * x + at_[1] * y + at_[2]) * per_w, (at_[3] * x + at_[4] * y + at_[5]) * per_w};
}

double MarkerModel::Light(const Vector2d& place, MarkerVector* gradient) const {
  const Vector2d cells = InCells(place);
  const double u = cells.x(), v = cells.y();
  const double x = place.x(), y = place.y(), per_w = 1 / (at_[6] * x + at_[7] * y + 1);
  // Sigmas of blur per cell: the blur is round in the picture.
  const double sigma_u = sigma_ * per_w * Vector2d(at_[0] - u * at_[6], at_[1] - u * at_[7]).norm();
  const double sigma_v = sigma_ * per_w * Vector2d(at_[3] - v * at_[6], at_[4] - v * at_[7]).norm();
  const InkSeen seen = Seen(ink_, AxisShares(u, sigma_u), AxisShares(v, sigma_v));
  const double odds = std::exp(at_[kRetreat]), part = seen.share + odds * (1 - seen.share);
  const double ink = seen.share / part, depth = at_[kInk] - at_[kPaper];
  const Vector2d lamp_place = place / kMarkerCells;
  const double lamp = 1 + at_[kLampX] * lamp_place.x() + at_[kLampY] * lamp_place.y();
  const double light = at_[kPaper] + depth * ink;
  gradient->setZero();
  if (lamp * light >= 1) return 1;
  const double rise = lamp * depth * odds / (part * part);
  const double along_u = rise * seen.along_u * per_w, along_v = rise * seen.along_v * per_w;
  const double w = along_u * u + along_v * v;
  gradient->head<kHomography>() << along_u * x, along_u * y, along_u, along_v * x, along_v * y,
      along_v, -w * x, -w * y;
  (*gradient)[kPaper] = lamp * (1 - ink);
  (*gradient)[kInk] = lamp * ink;
  (*gradient)[kBlur] = rise * (seen.softening_u * sigma_u + seen.softening_v * sigma_v) *
                       at_[kBlur] / (total_blur_px_ * total_blur_px_);
  (*gradient)[kLampX] = light * lamp_place.x();
  (*gradient)[kLampY] = light * lamp_place.y();
  (*gradient)[kRetreat] = -rise * seen.share * (1 - seen.share);
  return lamp * light;
}

bool MarkerModel::IsNearBorder(const Vector2d& cells, double reach) const {
  const int left = CellAt(cells.x() - reach), right = CellAt(cells.x() + reach);
  const int top = CellAt(cells.y() - reach), bottom = CellAt(cells.y() + reach);
  const bool ink = HasInk(ink_, top, left);
  return HasInk(ink_, top, right) != ink || HasInk(ink_, bottom, left) != ink ||
         HasInk(ink_, bottom, right) != ink;
}

int MarkerModel::CellOf(const Vector2d& cells) {
  return (CellAt(cells.y()) + 1) * kCellsAcross + CellAt(cells.x()) + 1;
}

double CellsToLine(const Vector2d& cells) {
  const auto to_line = [](double cell) {
    return cell < 0 || cell > kMarkerCells ? std::max(-cell, cell - kMarkerCells)
                                           : std::abs(cell - static_cast<int>(cell + 0.5));
  };
  const double across = to_line(cells.x()), down = to_line(cells.y());
  const Vector2d off = cells - cells.cwiseMax(0.0).cwiseMin(double{kMarkerCells});
  return off.isZero() ? std::min(across, down) : off.norm();
}

}  // namespace bladecurve
