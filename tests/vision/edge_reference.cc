// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_reference.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/edge_unknowns.h"
#include "vision/image/blurred_step.h"

namespace bladecurve::testing {
namespace {

struct Pixel {
  double across, along, grey;
};

std::vector<Pixel> PixelsBeside(const cv::Mat& grey, const TrueEdge& edge) {
  const Eigen::Vector2d tangent(-edge.normal.y(), edge.normal.x());
  std::vector<Pixel> pixels;
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const Eigen::Vector2d from_middle = Eigen::Vector2d(x, y) - edge.middle_px;
      const double across = edge.normal.dot(from_middle), along = tangent.dot(from_middle);
      if (std::abs(across) <= edge.reach_px && std::abs(along) <= 0.5 * edge.length_px)
        pixels.push_back({across, along, static_cast<double>(grey.at<uchar>(y, x))});
    }
  }
  return pixels;
}

// One step of Gauss and Newton.
Unknowns Improved(const std::vector<Pixel>& pixels, const TrueEdge& edge, const Unknowns& at) {
  const BlurredStep step(edge.normal, at[kBlur]);
  const double contrast = at[kGround] - at[kBlade];
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal = decltype(normal)::Zero();
  Unknowns right = Unknowns::Zero();
  for (const Pixel& pixel : pixels) {
    const StepSample sample = step.At(pixel.across - at[kOffset] - at[kAngle] * pixel.along);
    const double shift = -contrast * sample.slope;
    Unknowns gradient;
    gradient << shift, shift * pixel.along, 1 - sample.step, sample.step, contrast * sample.spread;
    normal += gradient * gradient.transpose();
    right += (pixel.grey - at[kBlade] - contrast * sample.step) * gradient;
  }
  return at + normal.ldlt().solve(right);
}

}  // namespace

double ReferenceError(const cv::Mat& grey, const TrueEdge& edge) {
  constexpr int kSteps = 6;  // from the truth; each squares the distance from the maximum
  constexpr double kLeastBlur = 0.2;
  const std::vector<Pixel> pixels = PixelsBeside(grey, edge);
  Unknowns found;
  found << 0, 0, edge.blade, edge.ground, edge.blur_px;
  for (int step = 0; step < kSteps; ++step) {
    found = Improved(pixels, edge, found);
    found[kBlur] = std::max(found[kBlur], kLeastBlur);
  }
  return found[kOffset];
}

}  // namespace bladecurve::testing
