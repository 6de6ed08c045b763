// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/square_images.h"

#include <cmath>
#include <vector>

#include "vision/scale/marker_detector.h"

namespace bladecurve {
namespace {

constexpr int kPattern = 4, kCells = 6;  // of a marker, on a side; the border counts as cells

double NormalIntegral(double z) {
  constexpr double kFar = 9;  // from there on a double tells no difference
  return std::abs(z) > kFar ? (z > 0 ? 1 : 0) : 0.5 * std::erfc(-z / std::sqrt(2.0));
}

const std::array<bool, kPattern * kPattern>& CellsOf(int id) {
  static const std::vector all = [] {
    std::vector<std::array<bool, kPattern * kPattern>> cells;
    for (int i = 0; i < kDictionarySize; ++i) cells.push_back(MarkerCells(i));
    return cells;
  }();
  return all[static_cast<size_t>(id)];
}

// What a blurred slab from `low` to `high` lets through at u.
double Slab(double u, double low, double high, double sigma) {
  return NormalIntegral((u - low) / sigma) - NormalIntegral((u - high) / sigma);
}

Eigen::Vector2d InSides(const SquareImage& image, const Eigen::Vector2d& point) {
  const Eigen::Vector2d d = point - image.centre_px;
  const double c = std::cos(image.angle_rad), s = std::sin(image.angle_rad);
  return Eigen::Vector2d(c * d.x() + s * d.y(), -s * d.x() + c * d.y()) / image.side_px;
}

bool FarFromSides(const SquareImage& image, int x, int y) {
  const Eigen::Vector2d off = InSides(image, {x, y}).cwiseAbs() * image.side_px;
  const double h = 0.5 * image.side_px, far = 7 * image.blur_px + 1;
  if (off.maxCoeff() > h + far) return true;
  const double spacing = image.marker ? image.side_px / kCells : h;
  const auto far_from_lines = [&](double from_middle) {
    return std::abs(from_middle - spacing * std::round(from_middle / spacing)) > far;
  };
  return far_from_lines(off.x()) && far_from_lines(off.y());
}

double PixelMean(const SquareImage& image, int x, int y) {
  if (FarFromSides(image, x, y)) return Inside(image, InSides(image, {x, y}), image.blur_px);
  constexpr double kNode[] = {
      -0.4305681557970263, -0.1699905217924281, 0.1699905217924281, 0.4305681557970263};
  constexpr double kWeight[] = {
      0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      sum += kWeight[i] * kWeight[j] *
             Inside(image, InSides(image, {x + kNode[i], y + kNode[j]}), image.blur_px);
  }
  return sum;
}

}  // namespace

double Inside(const SquareImage& image, const Eigen::Vector2d& sides, double sigma_px) {
  const double sigma = sigma_px / image.side_px;
  const double square = Slab(sides.x(), -0.5, 0.5, sigma) * Slab(sides.y(), -0.5, 0.5, sigma);
  if (!image.marker) return square;
  const auto& paper = CellsOf(*image.marker);
  std::array<double, kPattern> across{}, down{};
  for (int i = 0; i < kPattern; ++i) {
    const double low = (i + 1.0) / kCells - 0.5, high = low + 1.0 / kCells;
    across[static_cast<size_t>(i)] = Slab(sides.x(), low, high, sigma);
    down[static_cast<size_t>(i)] = Slab(sides.y(), low, high, sigma);
  }
  double light = 0;
  for (size_t i = 0; i < paper.size(); ++i)
    light += paper[i] ? across[i % kPattern] * down[i / kPattern] : 0;
  return square - light;
}

ToneCurve LinearToneCurve() {
  ToneCurve tone;
  for (size_t v = 0; v < 256; ++v)
    tone.linear[v] = static_cast<float>(static_cast<double>(v) / 255);
  return tone;
}

std::array<Eigen::Vector2d, 4> Corners(const SquareImage& image) {
  const double c = std::cos(image.angle_rad), s = std::sin(image.angle_rad),
               h = 0.5 * image.side_px;
  const Eigen::Vector2d u(h * c, h * s), v(-h * s, h * c);
  const Eigen::Vector2d& m = image.centre_px;
  return {m - u - v, m + u - v, m + u + v, m - u + v};
}

cv::Mat Draw(const SquareImage& image, std::mt19937* random) {
  cv::Mat grey(image.height, image.width, CV_8UC1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double light = image.bright + (image.dark - image.bright) * PixelMean(image, x, y);
      const double stored = 255 * std::pow(light, 1 / image.encoding_gamma);
      grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(stored + image.noise * Normal(random));
    }
  }
  return grey;
}

double Uniform(std::mt19937* random, double low, double high) {
  return low + (high - low) * (static_cast<double>((*random)()) + 0.5) / 4294967296.0;
}

double Normal(std::mt19937* random) {
  const double radius = std::sqrt(-2 * std::log(Uniform(random, 0, 1)));
  return radius * std::cos(2 * M_PI * Uniform(random, 0, 1));
}

}  // namespace bladecurve
