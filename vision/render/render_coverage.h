// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace bladecurve::render {

using Ring = std::vector<Eigen::Vector2d>;  // a closed polyline; the last point joins the first
using Polygon = std::vector<Ring>;  // holes run against their outer ring; rings of like direction
                                    // do not overlap

// Square cells in image pixels: cell (c, r) spans [origin + step c, origin + step (c + 1)] in x,
// likewise in y. The pixels themselves are {(-0.5, -0.5), 1, width, height}.
struct CoverageGrid {
  Eigen::Vector2d origin_px = Eigen::Vector2d(-0.5, -0.5);
  double step_px = 1;
  int cols = 0, rows = 0;
};

// The share of each cell that the polygon covers, CV_32F, 0 to 1: exact up to rounding, no samples
// taken.
[[nodiscard]] cv::Mat1f PolygonCoverage(const Polygon& polygon, const CoverageGrid& grid);

// The lens and the pixel: a Gaussian and the pixel's box, as weights over cells `oversampling` to a
// pixel.
struct PixelKernel {
  int oversampling = 1;        // cells a pixel, each way
  int halo_px = 0;             // pixels that the kernel reaches beyond its own
  std::vector<float> weights;  // oversampling * (1 + 2 halo_px) of them, sum 1; separable
};

// Cells fine enough that a straight edge's blurred profile is within 1e-3 of the closed form for
// blur_px >= 0.5.
[[nodiscard]] PixelKernel MakePixelKernel(double blur_px);

// Cells (with a halo on every side) to pixels: rows and columns shrink to (cells / oversampling - 2
// halo).
[[nodiscard]] cv::Mat1f IntegratePixels(const cv::Mat1f& cells, const PixelKernel& kernel);

}  // namespace bladecurve::render
