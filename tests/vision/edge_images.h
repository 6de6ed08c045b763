// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <random>

#include "vision/image/tone_curve.h"

namespace bladecurve::testing {

// How a synthetic edge is photographed. Levels and noise in grey values of a linear 8-bit camera.
struct EdgeLook {
  double blur_px = 1;
  double blade = 60, ground = 180;
  double noise = 2;
  double gamma = 1;  // stored = 255 (light/255)^(1/gamma)
};

// Normally distributed numbers, the same on every machine (Box and Muller 1958).
class Gaussian {
 public:
  explicit Gaussian(std::uint32_t seed) : engine_(seed) {}
  double operator()();
  double Uniform() { return (engine_() + 0.5) / 4294967296.0; }

 private:
  std::mt19937 engine_;
};

// Unit vector at this angle from +x towards +y.
[[nodiscard]] inline Eigen::Vector2d Direction(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

[[nodiscard]] inline double NormalCdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

// A step from 0 to 1, blurred by a Gaussian, d px beyond its middle.
[[nodiscard]] inline double Smooth(double d, double blur_px = 0.8) {
  return NormalCdf(d / blur_px);
}

// Share of background in each pixel, CV_64F, exact to 1e-8, by formulas that share nothing with the
// detector's. Half-plane: the point (x, y) is background where normal . (x, y) > offset.
[[nodiscard]] cv::Mat HalfPlaneCoverage(cv::Size size,
                                        const Eigen::Vector2d& normal,
                                        double offset,
                                        double blur_px);
// Blade inside the circle.
[[nodiscard]] cv::Mat DiskCoverage(cv::Size size,
                                   const Eigen::Vector2d& center,
                                   double radius,
                                   double blur_px);

// Levels, noise, tone curve and rounding to 8 bits.
[[nodiscard]] cv::Mat Photographed(const cv::Mat& coverage, const EdgeLook& look, Gaussian& noise);
[[nodiscard]] cv::Mat Stored(const cv::Mat& light, double noise, double gamma, Gaussian& random);

// stored = light^(1/gamma), both in [0, 1].
[[nodiscard]] ToneCurve GammaCurve(double gamma);

}  // namespace bladecurve::testing
