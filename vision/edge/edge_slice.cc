// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_slice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vision/edge/edge_path.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

// Unknowns of a slice: offset, own level of the blade, own level of the background.
using Matrix3 = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

constexpr double kRoughness = 0.5;  // px; a slice that says nothing takes after its neighbours
constexpr double kHeld = 1 / (kRoughness * kRoughness);

double PrecisionOf(double texture, double strayed) {
  constexpr double kNone = 1e-5;  // linear light; smaller ones are no texture
  const double sigma = std::max({texture, strayed, kNone});
  return 1 / (sigma * sigma);
}

// What the side's own mean strays beyond what texture does, linear light.
double Strayed(const SideRest& rest, double texture) {
  constexpr double kUsual = 2.5;  // texture sigmas
  constexpr double kFewest = 2;   // pixels
  const bool strays = rest.pixels >= kFewest && std::abs(rest.mean) > kUsual * texture;
  return strays && texture > 0 ? std::abs(rest.mean) : 0;
}

}  // namespace

double TextureSigma(const std::vector<SideRest>& slices, double noise) {
  constexpr double kDoubt = 2;  // standard deviations of the variance that noise alone shows
  std::vector<double> means;
  double inverse = 0;
  for (const SideRest& slice : slices) {
    if (slice.pixels < 1) continue;
    means.push_back(slice.mean);
    inverse += 1 / slice.pixels;
  }
  if (means.size() < 2) return 0;
  const auto count = static_cast<double>(means.size());
  const double by_noise = noise * noise * inverse / count, seen = std::pow(RobustSigma(means), 2);
  return std::sqrt(std::max(seen - by_noise * (1 + kDoubt * std::sqrt(2 / count)), 0.0));
}

SliceRests RestsOf(std::span<const PreparedPixel> pixels, const LevelVector& levels) {
  constexpr double kPlain = 0.02;
  SliceRests rests;
  for (const PreparedPixel& pixel : pixels) {
    const double step = pixel.terms[kGround];
    if (pixel.weight == 0 || (step > kPlain && step < 1 - kPlain)) continue;
    SideRest& side = step < 0.5 ? rests.blade : rests.ground;
    side.mean += pixel.light - levels.dot(pixel.terms);
    ++side.pixels;
  }
  rests.blade.mean /= std::max(rests.blade.pixels, 1.0);
  rests.ground.mean /= std::max(rests.ground.pixels, 1.0);
  return rests;
}

EdgeSlice SolveSlice(std::span<const PreparedPixel> pixels,
                     const LevelVector& levels,
                     const SliceTexture& texture,
                     double kept) {
  constexpr int kRounds = 2;  // the gradient depends on the levels
  const SliceRests rests = RestsOf(pixels, levels);
  const Vector3 prior(kHeld,
                      PrecisionOf(texture.blade, Strayed(rests.blade, texture.blade)),
                      PrecisionOf(texture.ground, Strayed(rests.ground, texture.ground)));
  const double contrast = levels[kGround] - levels[kBlade];
  Vector3 found = Vector3::Zero();
  double information = 0;
  for (int round = 0; round < kRounds; ++round) {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    for (const PreparedPixel& pixel : pixels) {
      const double gradient = -(contrast + found[2] - found[1]) * pixel.terms[kShift];
      const Vector3 row(gradient, 1 - pixel.terms[kGround], pixel.terms[kGround]);
      normal += pixel.weight * row * row.transpose();
      right += pixel.weight * (pixel.light - levels.dot(pixel.terms)) * row;
    }
    normal(1, 1) += prior[1];
    normal(2, 2) += prior[2];
    information = 1 / normal.inverse()(0, 0);
    normal(0, 0) += prior[0];
    found = normal.ldlt().solve(right);
  }
  EdgeSlice slice;
  slice.offset_px = found[0];
  slice.contrast = contrast + found[2] - found[1];
  slice.ground = levels[kGround] + found[2];
  slice.slope = std::hypot(levels[kBladeSlope], levels[kGroundSlope]);
  slice.held = kHeld / (kHeld + std::max(information, 0.0));
  slice.sigma_px = information > 0 && std::isfinite(information)
                       ? 1 / std::sqrt(information * kept)
                       : std::numeric_limits<double>::infinity();
  return slice;
}

void HoldToNeighbours(double spacing_px, std::vector<EdgeSlice>* slices) {
  constexpr double kLength = 50;    // px; as far as a window reaches
  constexpr double kOnPath = 0.01;  // 1/px^2 a slice: where nothing is seen the path stands
  std::vector<double> offsets, weights;
  for (const EdgeSlice& slice : *slices) {
    // Unheld, offset_px / (1 - held), of weight kHeld (1 - held) / held.
    const double information = kHeld * (1 - slice.held) / slice.held;
    weights.push_back(information + kOnPath);
    offsets.push_back((information + kHeld) * slice.offset_px / weights.back());
  }
  const double stiffness =
      Median(weights) * std::pow(kLength / spacing_px / (2 * std::numbers::pi), 4);
  const std::vector<double> trend = SmoothValues(offsets, weights, stiffness);
  for (size_t k = 0; k < slices->size(); ++k)
    (*slices)[k].offset_px += (*slices)[k].held * trend[k];
}

std::vector<EdgeSlice> SolveSlices(const std::vector<std::vector<PreparedPixel>>& slices,
                                   const SliceSampling& sampling,
                                   const EdgeWindows& windows) {
  std::vector<SideRest> blade, ground;
  for (size_t k = 0; k < slices.size(); ++k) {
    const int sample = static_cast<int>(k) * sampling.stride;
    const SliceRests rests = RestsOf(slices[k], windows.LevelsAt(sample));
    blade.push_back(rests.blade);
    ground.push_back(rests.ground);
  }
  const SliceTexture texture = {TextureSigma(blade, sampling.noise_blade),
                                TextureSigma(ground, sampling.noise_ground)};
  std::vector<EdgeSlice> solved;
  for (size_t k = 0; k < slices.size(); ++k) {
    const int sample = static_cast<int>(k) * sampling.stride;
    const double kept = windows.Nearest(sample).kept_information;
    solved.push_back(SolveSlice(slices[k], windows.LevelsAt(sample), texture, kept));
    solved.back().sample = sample;
  }
  HoldToNeighbours(sampling.stride, &solved);
  return solved;
}

}  // namespace bladecurve
