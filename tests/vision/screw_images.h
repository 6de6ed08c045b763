// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

namespace bladecurve {

// A screw's head on a plain or brushed plate; every part is symmetric about the centre, so that the
// centre is exact whatever the sampling does. Levels in linear light, 0 to 1.
struct HeadSpec {
  int side_px = 201;
  Eigen::Vector2d center_px{100, 100};
  double semi_major_px = 20, semi_minor_px = 20, angle_rad = 0;
  double plate = 0.35;
  double disc = 0;  // level of the head minus that of the plate
  double groove =
      0;  // level added along the rim (negative: a dark groove, positive: a bright ring)
  double groove_px = 0.8;                         // its Gaussian sigma, before the blur
  double slot = 0;                                // level added in the slot
  double slot_width = 0.2, slot_angle_rad = 0.6;  // width over the head's diameter
  double brushed = 0;  // relative standard deviation of the grain of plate and head
  double brushed_angle_rad = 0.3;
  double blur_px = 1.0;  // Gaussian sigma of the lens; the pixel's box comes on top
  double noise = 2;      // standard deviation, encoded grey values
  std::uint32_t seed = 1;
};

// Encoded grey values before noise and rounding, CV_64F.
[[nodiscard]] cv::Mat RenderHeadExactly(const HeadSpec& spec);
// CV_8UC1 with noise.
[[nodiscard]] cv::Mat RenderHead(const HeadSpec& spec);

// Standard deviation of the best unbiased estimate of the centre's x (Cramer-Rao), pixel noise,
// rounding and the grain's correlated noise counted; the head's shape and look are taken as known,
// which costs nothing: they are even about the centre, it is odd.
[[nodiscard]] double CenterBoundPx(const HeadSpec& spec);

// Uniform in [0, 1) and standard normal from the same generator on every platform.
class Draws {
 public:
  explicit Draws(std::uint32_t seed) : state_(seed) {}
  double Uniform(double low = 0, double high = 1);
  double Normal();

 private:
  std::uint64_t state_;
};

}  // namespace bladecurve
