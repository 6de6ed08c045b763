// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Oracles: clipping a polygon with a cell gives the exact area; a blurred half-plane has a closed
// form.
#include "vision/render/render_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace bladecurve::render {
namespace {

double SignedArea(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

// The part of the ring where dot(normal, p) <= limit (Sutherland and Hodgman 1974).
Ring ClipHalfPlane(const Ring& ring, const Eigen::Vector2d& normal, double limit) {
  Ring clipped;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double da = normal.dot(a) - limit, db = normal.dot(b) - limit;
    if (da <= 0) clipped.push_back(a);
    if ((da < 0) != (db < 0) && da != db) clipped.push_back(a + (b - a) * (da / (da - db)));
  }
  return clipped;
}

double AreaInCell(const Polygon& polygon, double x, double y, double size) {
  double area = 0;
  for (const Ring& ring : polygon) {
    Ring part = ClipHalfPlane(ring, {1, 0}, x + size);
    part = ClipHalfPlane(part, {-1, 0}, -x);
    part = ClipHalfPlane(part, {0, 1}, y + size);
    part = ClipHalfPlane(part, {0, -1}, -y);
    area += SignedArea(part);
  }
  return std::abs(area) / (size * size);
}

Ring Star(std::mt19937* engine, const Eigen::Vector2d& center, double radius, bool reversed) {
  std::uniform_real_distribution<double> spread(0.4, 1.0);
  Ring ring;
  constexpr int kPoints = 23;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = (reversed ? -2 : 2) * std::numbers::pi * i / kPoints;
    ring.push_back(center +
                   radius * spread(*engine) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

void ExpectExact(const Polygon& polygon, const CoverageGrid& grid) {
  constexpr double kFloatSums = 2e-5;  // some hundred float additions a row
  const cv::Mat1f coverage = PolygonCoverage(polygon, grid);
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) {
      const Eigen::Vector2d corner = grid.origin_px + grid.step_px * Eigen::Vector2d(c, r);
      ASSERT_NEAR(
          coverage(r, c), AreaInCell(polygon, corner.x(), corner.y(), grid.step_px), kFloatSums)
          << "cell " << c << ", " << r;
    }
  }
}

TEST(PolygonCoverage, IsTheClippedAreaOfEveryCell) {
  std::mt19937 engine(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Polygon polygon = {Star(&engine, {14.3, 11.7}, 10, false),
                             Star(&engine, {14.3, 11.7}, 3.5, true)};
    ExpectExact(polygon, {.cols = 30, .rows = 24});
  }
}

TEST(PolygonCoverage, IsRightWhereThePolygonLeavesTheGrid) {
  std::mt19937 engine(8);
  for (int trial = 0; trial < 20; ++trial) {
    const Polygon polygon = {Star(&engine, {6, 5}, 14, false)};
    ExpectExact(polygon, {.origin_px = {2.5, 1.5}, .step_px = 0.37, .cols = 20, .rows = 17});
  }
}

TEST(PolygonCoverage, OfDegenerateRingsIsNothing) {
  const CoverageGrid grid{.cols = 5, .rows = 5};
  for (const Polygon& polygon :
       {Polygon{}, Polygon{{}}, Polygon{{{1, 1}}}, Polygon{{{1, 1}, {3, 2}}}}) {
    EXPECT_NEAR(cv::sum(PolygonCoverage(polygon, grid))[0], 0, 1e-6);
  }
}

// Integrals of the normal distribution function, once and twice.
double Once(double z) {
  return z * 0.5 * std::erfc(-z / std::numbers::sqrt2) +
         std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
}
double Twice(double z) {
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
  return 0.5 * ((z * z + 1) * 0.5 * std::erfc(-z / std::numbers::sqrt2) + z * density);
}

// Share of the half-plane dot(normal, p) < 0 in a pixel whose centre lies d beyond its border,
// blurred by sigma.
double BlurredHalfPlane(double d, const Eigen::Vector2d& normal, double sigma) {
  const double a = 0.5 * std::abs(normal.x()), b = 0.5 * std::abs(normal.y());
  if (std::min(a, b) < 1e-9) {
    const double h = std::max(a, b);
    return sigma / (2 * h) * (Once((-d + h) / sigma) - Once((-d - h) / sigma));
  }
  return sigma * sigma / (4 * a * b) *
         (Twice((-d + a + b) / sigma) - Twice((-d + a - b) / sigma) - Twice((-d - a + b) / sigma) +
          Twice((-d - a - b) / sigma));
}

TEST(IntegratePixels, OfAStraightEdgeIsTheClosedForm) {
  constexpr double kPromised = 1e-3;
  constexpr int kSize = 16;
  for (const double blur : {0.5, 0.7, 1.0, 1.6, 2.0}) {
    const PixelKernel kernel = MakePixelKernel(blur);
    const int cells = (kSize + 2 * kernel.halo_px) * kernel.oversampling;
    const double start = -0.5 - kernel.halo_px;
    const CoverageGrid grid{.origin_px = {start, start},
                            .step_px = 1.0 / kernel.oversampling,
                            .cols = cells,
                            .rows = cells};
    for (const double degrees : {0.0, 7.0, 31.0, 45.0, 90.0, 200.0}) {
      const double angle = degrees * std::numbers::pi / 180;
      const Eigen::Vector2d normal(std::cos(angle), std::sin(angle)),
          along(-normal.y(), normal.x());
      const Eigen::Vector2d foot(7.83, 7.31);
      constexpr double kFar = 100;
      const Polygon half_plane = {{foot + kFar * along,
                                   foot + kFar * (along - normal),
                                   foot - kFar * (along + normal),
                                   foot - kFar * along}};
      const cv::Mat1f pixels = IntegratePixels(PolygonCoverage(half_plane, grid), kernel);
      ASSERT_EQ(pixels.rows, kSize);
      for (int r = 0; r < kSize; ++r) {
        for (int c = 0; c < kSize; ++c) {
          const double d = normal.dot(Eigen::Vector2d(c, r) - foot);
          ASSERT_NEAR(pixels(r, c), BlurredHalfPlane(d, normal, blur), kPromised)
              << "blur " << blur << ", " << degrees << " degrees, pixel " << c << ", " << r;
        }
      }
    }
  }
}

TEST(IntegratePixels, KeepsTheAreaOfADisk) {
  constexpr int kSize = 40;
  const PixelKernel kernel = MakePixelKernel(0.9);
  const int cells = (kSize + 2 * kernel.halo_px) * kernel.oversampling;
  const double start = -0.5 - kernel.halo_px;
  const CoverageGrid grid{.origin_px = {start, start},
                          .step_px = 1.0 / kernel.oversampling,
                          .cols = cells,
                          .rows = cells};
  Ring disk;
  constexpr int kPoints = 4000;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    disk.push_back(Eigen::Vector2d(19.2, 20.6) +
                   12.5 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const double area = cv::sum(IntegratePixels(PolygonCoverage({disk}, grid), kernel))[0];
  EXPECT_NEAR(area / (std::numbers::pi * 12.5 * 12.5), 1, 1e-5);
}

}  // namespace
}  // namespace bladecurve::render
