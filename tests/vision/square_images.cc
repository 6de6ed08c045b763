// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/square_images.h"

#include <cmath>

namespace bladecurve {
namespace {

double NormalIntegral(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Light missing at a point: 1 deep inside the square.
double Inside(const SquareImage& image, const Eigen::Vector2d& point) {
  const Eigen::Vector2d d = point - image.centre_px;
  const double c = std::cos(image.angle_rad), s = std::sin(image.angle_rad),
               h = 0.5 * image.side_px;
  const auto slab = [&](double u) {
    return NormalIntegral((u + h) / image.blur_px) - NormalIntegral((u - h) / image.blur_px);
  };
  return slab(c * d.x() + s * d.y()) * slab(-s * d.x() + c * d.y());
}

// True where every point of the pixel is 7 sigma from each side: then the middle says it all.
bool FarFromSides(const SquareImage& image, int x, int y) {
  const Eigen::Vector2d d = Eigen::Vector2d(x, y) - image.centre_px;
  const double c = std::cos(image.angle_rad), s = std::sin(image.angle_rad),
               h = 0.5 * image.side_px;
  const double u = std::abs(c * d.x() + s * d.y()), v = std::abs(-s * d.x() + c * d.y());
  const double far = 7 * image.blur_px + 1;
  return std::max(u, v) > h + far || (std::abs(u - h) > far && std::abs(v - h) > far);
}

double PixelMean(const SquareImage& image, int x, int y) {
  if (FarFromSides(image, x, y))
    return Inside(image, {static_cast<double>(x), static_cast<double>(y)});
  constexpr double kNode[] = {
      -0.4305681557970263, -0.1699905217924281, 0.1699905217924281, 0.4305681557970263};
  constexpr double kWeight[] = {
      0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      sum += kWeight[i] * kWeight[j] * Inside(image, {x + kNode[i], y + kNode[j]});
  }
  return sum;
}

}  // namespace

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
