// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <random>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// A dark square on a bright ground, turned by any angle. Blurred by a Gaussian and integrated over
// each pixel: in the square's own axes the blurred square is a product of two differences of normal
// distributions, so the picture is exact to 1e-6 by a 4 x 4 Gauss-Legendre rule a pixel.
struct SquareImage {
  int width = 260, height = 260;
  Eigen::Vector2d centre_px{130, 130};
  double side_px = 120, angle_rad = 0.1;
  double blur_px = 1;
  double dark = 50 / 255.0, bright = 200 / 255.0;  // linear light
  double noise = 2;                                // grey values
  double encoding_gamma = 1;                       // stored = light^(1 / gamma)
  std::optional<int> marker;                       // of DICT_4X4_50; absent: a plain dark square
};

// How much of the blurred dark a place sees; x and y in sides from the middle, x along the first
// side.
[[nodiscard]] double Inside(const SquareImage& image,
                            const Eigen::Vector2d& sides,
                            double sigma_px);

// Corners clockwise from the top left.
[[nodiscard]] std::array<Eigen::Vector2d, 4> Corners(const SquareImage& image);

[[nodiscard]] cv::Mat Draw(const SquareImage& image, std::mt19937* random);

// Of a picture whose encoding_gamma is 1.
[[nodiscard]] ToneCurve LinearToneCurve();

// Normal deviate by Box and Muller: the same on every platform.
[[nodiscard]] double Normal(std::mt19937* random);
[[nodiscard]] double Uniform(std::mt19937* random, double low, double high);

}  // namespace bladecurve
