// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/straight_edge.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vision/scale/straight_band.h"
#include "vision/scale/straight_fit.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

StraightEdge Describe(const StraightFit& fit, const StraightEdgeBand& band, double used) {
  const StraightVector& p = fit.parameters;
  const double c = std::cos(p[kAngle]), s = std::sin(p[kAngle]);
  StraightEdge edge;
  // The line {across cos - along sin = offset}, at the foot of the band's middle.
  edge.direction = c * band.direction + s * band.normal;
  edge.middle_px = band.middle + p[kOffset] * edge.normal();
  edge.length_px = band.length;
  edge.bow_px = band.bow;
  edge.covariance = fit.covariance.topLeftCorner<2, 2>();
  edge.blur_px = p[kEdgeBlur];
  edge.noise = std::sqrt(fit.mean_square);
  edge.contrast = p[kContrast];
  edge.bright = BrightSide(p);
  edge.used = used;
  return edge;
}

}  // namespace

std::optional<StraightEdge> LocateStraightEdge(const cv::Mat& grey,
                                               const ToneCurve& tone,
                                               const StraightEdgeGuess& guess) {
  const LinearPicture picture{grey, tone};
  const StraightEdgeBand wide =
      MakeBand(guess, std::min(guess.search_px + 4, std::max(guess.free_px, 2.5)));
  const int thin = std::max(1, static_cast<int>(wide.length / 60));
  const std::vector<BandSample> coarse = Collect(picture, wide, thin);
  if (coarse.size() < 3 * kStraightParameters) return std::nullopt;
  const std::optional<StraightVector> start = StartOf(coarse, wide);
  if (!start) return std::nullopt;
  const std::optional<StraightFit> rough = RefineStraight(coarse, wide, *start);
  if (!rough) return std::nullopt;
  // The final band is as wide as the blur needs for its levels and no wider, along the line just
  // found.
  const StraightEdge found = Describe(*rough, wide, 1);
  const double blur = std::hypot(found.blur_px, 0.3);
  StraightEdgeGuess better = guess;
  better.from_px = found.middle_px - 0.5 * wide.length * found.direction;
  better.to_px = found.middle_px + 0.5 * wide.length * found.direction;
  const StraightEdgeBand band =
      MakeBand(better, std::min(std::max(4.0, 5 * blur), std::max(guess.free_px, 2.0)));
  StraightVector parameters = rough->parameters;
  parameters[kOffset] = parameters[kAngle] = 0;
  std::vector<BandSample> samples = Collect(picture, band, 1);
  const double all = static_cast<double>(samples.size());
  std::optional<StraightFit> fit = RefineStraight(samples, band, parameters);
  for (int pass = 0; pass < 2 && fit; ++pass) {
    samples = WithoutCovered(samples, band, fit->parameters);
    if (samples.size() == fit->count) break;
    fit = RefineStraight(samples, band, fit->parameters);
  }
  if (!fit) return std::nullopt;
  return Describe(*fit, band, static_cast<double>(fit->count) / all);
}

EdgeCrossing Cross(const StraightEdge& first, const StraightEdge& second) {
  // n . p = c for both; a bow moves c by what it is at the crossing, which two rounds settle.
  Eigen::Matrix2d normals;
  normals.row(0) = first.normal().transpose();
  normals.row(1) = second.normal().transpose();
  const Eigen::Matrix2d inverse = normals.inverse();
  const std::array<const StraightEdge*, 2> edges = {&first, &second};
  EdgeCrossing crossing{Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  Vector2d along = Vector2d::Zero();
  for (int round = 0; round < 3; ++round) {
    Vector2d offset;
    for (int i = 0; i < 2; ++i) {
      const StraightEdge& e = *edges[static_cast<size_t>(i)];
      const double x = 2 * along[i] / e.length_px;
      const double bow = round == 0 ? 0 : e.bow_px * (1 - x * x);
      offset[i] = e.normal().dot(e.middle_px) + bow;
    }
    crossing.point_px = inverse * offset;
    for (int i = 0; i < 2; ++i) {
      const StraightEdge& e = *edges[static_cast<size_t>(i)];
      along[i] = e.direction.dot(crossing.point_px - e.middle_px);
    }
  }
  Eigen::Matrix2d offsets = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vector2d lever(1, along[i]);
    offsets(i, i) = lever.dot(edges[static_cast<size_t>(i)]->covariance * lever);
  }
  crossing.covariance_px2 = inverse * offsets * inverse.transpose();
  return crossing;
}

}  // namespace bladecurve
