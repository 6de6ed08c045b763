// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bladecurve::render {
namespace {

// Adds one straight piece that stays inside one row of cells: `dy` is its signed height, x0 and x1
// its ends in cells. Area to the right of the piece counts; a prefix sum over the row turns the
// differences into covered areas.
void AddPieceInRow(float* row, double x0, double x1, double dy) {
  if (x0 > x1) std::swap(x0, x1);
  const int first = static_cast<int>(x0);
  const int last = std::max(first, static_cast<int>(std::ceil(x1)) - 1);
  const double slope = last > first ? dy / (x1 - x0) : 0;
  for (int c = first; c <= last; ++c) {
    const double a = std::max<double>(x0, c), b = std::min<double>(x1, c + 1);
    const double part = last > first ? slope * (b - a) : dy;
    const double right_of_piece = 1 - (0.5 * (a + b) - c);
    row[c] += static_cast<float>(part * right_of_piece);
    row[c + 1] += static_cast<float>(part * (1 - right_of_piece));
  }
}

// The same for a piece that may leave the grid sideways: what lies to the left acts as if on the
// left border, what lies to the right covers nothing.
void AddClippedPiece(float* row, double x0, double x1, double dy, int cols) {
  const double limit = cols;
  if (x0 >= limit && x1 >= limit) return;
  if (x0 <= 0 && x1 <= 0) {
    row[0] += static_cast<float>(dy);
    return;
  }
  if (x0 >= 0 && x1 >= 0 && x0 <= limit && x1 <= limit) {
    AddPieceInRow(row, x0, x1, dy);
    return;
  }
  const double border = std::min(x0, x1) < 0 ? 0 : limit;
  const double share = (border - x0) / (x1 - x0);
  AddClippedPiece(row, x0, border, dy * share, cols);
  AddClippedPiece(row, border, x1, dy * (1 - share), cols);
}

void AddSegment(cv::Mat1f* sums, Eigen::Vector2d p, Eigen::Vector2d q, int rows, int cols) {
  if (p.y() == q.y()) return;
  const double sign = p.y() < q.y() ? 1 : -1;
  if (sign < 0) std::swap(p, q);
  if (q.y() <= 0 || p.y() >= rows) return;
  const double dx_dy = (q.x() - p.x()) / (q.y() - p.y());
  const double top = std::max(p.y(), 0.0), bottom = std::min<double>(q.y(), rows);
  const int last_row = std::min(rows - 1, static_cast<int>(std::ceil(bottom)) - 1);
  for (int r = static_cast<int>(top); r <= last_row; ++r) {
    const double y0 = std::max<double>(top, r), y1 = std::min<double>(bottom, r + 1);
    const double x0 = p.x() + dx_dy * (y0 - p.y()), x1 = p.x() + dx_dy * (y1 - p.y());
    AddClippedPiece((*sums)[r], x0, x1, sign * (y1 - y0), cols);
  }
}

// Integral of the Gaussian's distribution function, twice: F'' is the Gaussian of standard
// deviation sigma.
double RampOfGaussian(double x, double sigma) {
  if (sigma <= 0) return std::max(x, 0.0);
  const double z = x / sigma;
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
  return sigma * (z * 0.5 * std::erfc(-z / std::numbers::sqrt2) + density);
}

// Share of the Gaussian that falls into [a, b], averaged over a pixel's box centred on 0.
double BoxedGaussian(double a, double b, double sigma) {
  const auto step_response = [sigma](double x) {
    return RampOfGaussian(x + 0.5, sigma) - RampOfGaussian(x - 0.5, sigma);
  };
  return step_response(b) - step_response(a);
}

}  // namespace

cv::Mat1f PolygonCoverage(const Polygon& polygon, const CoverageGrid& grid) {
  cv::Mat1f sums = cv::Mat1f::zeros(grid.rows, grid.cols + 1);
  for (const Ring& ring : polygon) {
    if (ring.empty()) continue;
    Eigen::Vector2d previous = (ring.back() - grid.origin_px) / grid.step_px;
    for (const Eigen::Vector2d& point : ring) {
      const Eigen::Vector2d next = (point - grid.origin_px) / grid.step_px;
      AddSegment(&sums, previous, next, grid.rows, grid.cols);
      previous = next;
    }
  }
  cv::Mat1f coverage(grid.rows, grid.cols);
  for (int r = 0; r < grid.rows; ++r) {
    float area = 0;
    for (int c = 0; c < grid.cols; ++c) {
      area += sums(r, c);
      coverage(r, c) = std::min(std::abs(area), 1.0f);
    }
  }
  return coverage;
}

PixelKernel MakePixelKernel(double blur_px) {
  // Within a cell of width w an edge's place is lost: the profile f is interpolated linearly, which
  // is off by up to w^2 f'' / 8. A Gaussian narrower by w^2 / 6 in variance takes the mean of that
  // away and leaves w^2 f'' / 12, at most 1e-3 from 4.5 cells a sigma on, as f'' <= 0.242 /
  // sigma^2.
  constexpr double kCellsPerSigma = 4.5;
  constexpr int kMaxOversampling = 9;
  constexpr double kReachInSigmas = 4.5;  // the rest of the Gaussian is 7e-6
  PixelKernel kernel;
  if (blur_px > 0) {
    kernel.oversampling =
        std::clamp(static_cast<int>(std::ceil(kCellsPerSigma / blur_px)), 2, kMaxOversampling);
  }
  kernel.halo_px = static_cast<int>(std::ceil(kReachInSigmas * blur_px));
  const double width_px = 1.0 / kernel.oversampling;
  const double sigma_px = std::sqrt(std::max(0.0, blur_px * blur_px - width_px * width_px / 6));
  const int count = kernel.oversampling * (1 + 2 * kernel.halo_px);
  const double first = -0.5 - kernel.halo_px;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double weight = BoxedGaussian(first + i * width_px, first + (i + 1) * width_px, sigma_px);
    kernel.weights.push_back(static_cast<float>(weight));
    sum += weight;
  }
  for (float& weight : kernel.weights) weight = static_cast<float>(weight / sum);
  return kernel;
}

cv::Mat1f IntegratePixels(const cv::Mat1f& cells, const PixelKernel& kernel) {
  const int k = kernel.oversampling, taps = static_cast<int>(kernel.weights.size());
  const int rows = cells.rows / k - 2 * kernel.halo_px, cols = cells.cols / k - 2 * kernel.halo_px;
  // Columns first: whole rows are added up, which the compiler turns into vector code.
  cv::Mat1f tall = cv::Mat1f::zeros(rows, cells.cols);
  for (int r = 0; r < rows; ++r) {
    float* sum = tall[r];
    for (int i = 0; i < taps; ++i) {
      const float weight = kernel.weights[static_cast<std::size_t>(i)];
      const float* cell = cells[r * k + i];
      for (int c = 0; c < cells.cols; ++c) sum[c] += weight * cell[c];
    }
  }
  // Several sums at a time: none waits for another one's last addition.
  constexpr int kAtOnce = 8;
  cv::Mat1f pixels(rows, cols);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; c += kAtOnce) {
      const int count = std::min(kAtOnce, cols - c);
      const float* cell = tall[r] + static_cast<std::ptrdiff_t>(c) * k;
      std::array<float, kAtOnce> sums{};
      for (int i = 0; i < taps; ++i) {
        const float weight = kernel.weights[static_cast<std::size_t>(i)];
        for (int j = 0; j < count; ++j)
          sums[static_cast<std::size_t>(j)] += weight * cell[i + j * k];
      }
      std::copy_n(sums.begin(), count, pixels[r] + c);
    }
  }
  return pixels;
}

}  // namespace bladecurve::render
