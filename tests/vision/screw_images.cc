// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/screw_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/edge_images.h"

namespace bladecurve {
namespace {

double Encode(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

// Signed distance to the ellipse, inside negative; exact on it and to second order near it.
double DistanceToEllipse(const HeadSpec& spec, const Eigen::Vector2d& p) {
  const double c = std::cos(spec.angle_rad), s = std::sin(spec.angle_rad);
  const double x = (c * p.x() + s * p.y()) / spec.semi_major_px;
  const double y = (-s * p.x() + c * p.y()) / spec.semi_minor_px;
  const double value = std::hypot(x, y);
  if (value < 1e-9) return -spec.semi_minor_px;
  const double gradient = std::hypot(x / spec.semi_major_px, y / spec.semi_minor_px) / value;
  return (value - 1) / gradient;
}

constexpr double kGrainAlongPx = 8, kGrainAcrossPx = 0.7;  // Gaussian sigmas

// Grain: white noise drawn out along one direction, standard deviation 1.
cv::Mat BrushedGrain(int side, double angle_rad, std::uint32_t seed) {
  Draws draws(seed);
  const int wide = 2 * side;
  cv::Mat grain(wide, wide, CV_64F);
  for (int row = 0; row < wide; ++row) {
    for (int column = 0; column < wide; ++column) grain.at<double>(row, column) = draws.Normal();
  }
  cv::GaussianBlur(grain, grain, cv::Size(0, 0), kGrainAlongPx, kGrainAcrossPx);
  const cv::Point2f middle(static_cast<float>(wide) / 2.F, static_cast<float>(wide) / 2.F);
  cv::Mat turn = cv::getRotationMatrix2D(middle, -angle_rad * 180 / std::numbers::pi, 1.0);
  turn.at<double>(0, 2) -= side / 2.0;
  turn.at<double>(1, 2) -= side / 2.0;
  cv::Mat turned;
  cv::warpAffine(grain, turned, turn, cv::Size(side, side), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::Scalar mean, deviation;
  cv::meanStdDev(turned, mean, deviation);
  return (turned - mean[0]) / deviation[0];
}

// rad/px of a row or column of a spectrum.
double Frequency(int index, int count) {
  return 2 * std::numbers::pi * (2 * index > count ? index - count : index) / count;
}

// Power per pixel of noise, rounding and grain at a frequency, grey values squared. White noise
// that a Gaussian has drawn out to variance 1 has the density 4 pi s t exp(-(s k)^2 - (t l)^2).
double NoiseDensity(const HeadSpec& spec, const Eigen::Vector2d& frequency) {
  constexpr double kStep = 1e-4;
  const double white = spec.noise * spec.noise + 1.0 / 12;
  const double grey_per_light =
      (Encode(spec.plate + kStep) - Encode(spec.plate - kStep)) / (2 * kStep);
  const double grain = spec.brushed * spec.plate * grey_per_light;
  const double c = std::cos(spec.brushed_angle_rad), s = std::sin(spec.brushed_angle_rad);
  const double along = kGrainAlongPx * (c * frequency.x() + s * frequency.y());
  const double across = kGrainAcrossPx * (-s * frequency.x() + c * frequency.y());
  return white + grain * grain * 4 * std::numbers::pi * kGrainAlongPx * kGrainAcrossPx *
                     std::exp(-along * along - across * across);
}

}  // namespace

double Draws::Uniform(double low, double high) {
  state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth's MMIX generator
  return low + (high - low) * static_cast<double>(state_ >> 11U) / 9007199254740992.0;
}

double Draws::Normal() {
  const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
  return radius * std::cos(2 * std::numbers::pi * Uniform());
}

cv::Mat RenderHeadExactly(const HeadSpec& spec) {
  const double edge_sigma = std::sqrt(spec.blur_px * spec.blur_px + 1.0 / 12);
  const double groove_sigma = std::hypot(edge_sigma, spec.groove_px);
  const double groove_peak =
      spec.groove * spec.groove_px / groove_sigma;  // the blur keeps the area
  const double half_slot = spec.slot_width * spec.semi_minor_px;
  const Eigen::Vector2d across(-std::sin(spec.slot_angle_rad), std::cos(spec.slot_angle_rad));
  const cv::Mat grain = spec.brushed > 0
                            ? BrushedGrain(spec.side_px, spec.brushed_angle_rad, spec.seed + 7919)
                            : cv::Mat::zeros(spec.side_px, spec.side_px, CV_64F);
  cv::Mat image(spec.side_px, spec.side_px, CV_64F);
  for (int row = 0; row < spec.side_px; ++row) {
    for (int column = 0; column < spec.side_px; ++column) {
      const Eigen::Vector2d p = Eigen::Vector2d(column, row) - spec.center_px;
      const double distance = DistanceToEllipse(spec, p);
      const double inside = testing::NormalCdf(-distance / edge_sigma);
      const double from_slot = std::abs(across.dot(p));
      const double in_slot = inside * testing::NormalCdf((half_slot - from_slot) / edge_sigma);
      const double rim = std::exp(-0.5 * std::pow(distance / groove_sigma, 2));
      const double light =
          (spec.plate + spec.disc * inside) * (1 + spec.brushed * grain.at<double>(row, column)) +
          groove_peak * rim + spec.slot * in_slot;
      image.at<double>(row, column) = Encode(light);
    }
  }
  return image;
}

cv::Mat RenderHead(const HeadSpec& spec) {
  cv::Mat exact = RenderHeadExactly(spec);
  Draws draws(spec.seed);
  cv::Mat grey(exact.size(), CV_8UC1);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const double value = exact.at<double>(row, column) + spec.noise * draws.Normal();
      grey.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return grey;
}

double CenterBoundPx(const HeadSpec& spec) {
  constexpr double kStepPx = 0.01;
  HeadSpec before = spec, after = spec;
  before.brushed = after.brushed = 0;  // the grain stays where it is
  before.center_px.x() -= kStepPx / 2;
  after.center_px.x() += kStepPx / 2;
  const cv::Mat slope = (RenderHeadExactly(after) - RenderHeadExactly(before)) / kStepPx;
  cv::Mat spectrum;
  cv::dft(slope, spectrum, cv::DFT_COMPLEX_OUTPUT);
  // Noise that is alike everywhere is independent from frequency to frequency: there the Fisher
  // information adds up (Whittle 1953).
  double information = 0;
  for (int row = 0; row < spectrum.rows; ++row) {
    for (int column = 0; column < spectrum.cols; ++column) {
      const auto& wave = spectrum.at<cv::Vec2d>(row, column);
      const double density =
          NoiseDensity(spec, {Frequency(column, spectrum.cols), Frequency(row, spectrum.rows)});
      information += wave.dot(wave) / density;
    }
  }
  return std::sqrt(static_cast<double>(spectrum.total()) / information);
}

}  // namespace bladecurve
