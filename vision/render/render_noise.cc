// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_noise.h"

#include <cmath>
#include <numbers>

namespace bladecurve::render {
namespace {

// Finaliser of splitmix64 (Steele, Lea, Flood 2014): every bit of the input moves every bit of the
// output.
std::uint64_t Mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double Unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double CubicStep(double t) { return t * t * (3 - 2 * t); }

}  // namespace

std::uint64_t HashOf(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t column = Mix(seed + kGoldenRatio * static_cast<std::uint64_t>(x));
  return Mix(column + kGoldenRatio * static_cast<std::uint64_t>(y));
}

double UniformAt(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  return Unit(HashOf(seed, x, y));
}

double NormalAt(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  // Box and Muller 1958; 32 bits suffice for either variable.
  const std::uint64_t bits = HashOf(seed, x, y);
  const double radius = std::sqrt(-2 * std::log((static_cast<double>(bits >> 32) + 0.5) * 0x1p-32));
  const double angle = 2 * std::numbers::pi * static_cast<double>(bits & 0xffffffffULL) * 0x1p-32;
  return radius * std::cos(angle);
}

double SmoothNoise(std::uint64_t seed, double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
  const double tx = CubicStep(x - fx), ty = CubicStep(y - fy);
  const double top = UniformAt(seed, ix, iy) * (1 - tx) + UniformAt(seed, ix + 1, iy) * tx;
  const double bottom =
      UniformAt(seed, ix, iy + 1) * (1 - tx) + UniformAt(seed, ix + 1, iy + 1) * tx;
  return 2 * (top * (1 - ty) + bottom * ty) - 1;
}

double FractalNoise(std::uint64_t seed, double x, double y, int octaves) {
  double sum = 0, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * SmoothNoise(seed + static_cast<std::uint64_t>(i), x, y);
    weight *= 0.5;
    x *= 2;
    y *= 2;
  }
  return sum;
}

}  // namespace bladecurve::render
