// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace bladecurve::testing {
namespace {

// Gauss-Legendre, 8 points on [-1, 1]: exact for polynomials of degree 15.
constexpr std::array<double, 8> kNodes = {-0.9602898564975363,
                                          -0.7966664774136267,
                                          -0.5255324099163290,
                                          -0.1834346424956498,
                                          0.1834346424956498,
                                          0.5255324099163290,
                                          0.7966664774136267,
                                          0.9602898564975363};
constexpr std::array<double, 8> kWeights = {0.1012285362903763,
                                            0.2223810344533745,
                                            0.3137066458778873,
                                            0.3626837833783620,
                                            0.3626837833783620,
                                            0.3137066458778873,
                                            0.2223810344533745,
                                            0.1012285362903763};

// Integral over [a, b], split so that the blur is resolved.
template <typename Function>
double Integrate(double a, double b, int pieces, const Function& function) {
  double sum = 0;
  const double half = 0.5 * (b - a) / pieces;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = a + (2 * piece + 1) * half;
    for (size_t i = 0; i < kNodes.size(); ++i)
      sum += kWeights[i] * half * function(middle + half * kNodes[i]);
  }
  return sum;
}

// One axis of the point spread: pixel box and Gaussian together, its density and its integral.
double BoxedDensity(double u, double blur) {
  return NormalCdf((u + 0.5) / blur) - NormalCdf((u - 0.5) / blur);
}

double BoxedCdf(double u, double blur) {
  const auto once = [blur](double v) {
    const double z = v / blur;
    return v * NormalCdf(z) + blur * std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
  };
  return once(u + 0.5) - once(u - 0.5);
}

// What a pixel sees of a blurred half-plane, by the signed distance of its centre from the line:
// the mean of the blurred step over the pixel's area by quadrature, tabulated for pictures of many
// pixels.
class PixelProfile {
 public:
  PixelProfile(const Eigen::Vector2d& normal, double blur_px) : reach_px_(7 * blur_px + 0.75) {
    const int last = static_cast<int>(std::ceil(2 * reach_px_ * kPerPx)) + 2;
    for (int i = -1; i <= last; ++i) {
      const double distance = static_cast<double>(i) / kPerPx - reach_px_;
      nodes_.push_back(Integrate(-0.5, 0.5, 2, [&](double v) {
        return Integrate(-0.5, 0.5, 2, [&](double u) {
          return NormalCdf((distance + u * normal.x() + v * normal.y()) / blur_px);
        });
      }));
    }
  }

  // Cubic through the four nearest nodes (Lagrange).
  [[nodiscard]] double At(double distance_px) const {
    if (std::abs(distance_px) >= reach_px_) return distance_px > 0 ? 1 : 0;
    const double place = (distance_px + reach_px_) * kPerPx;
    const auto i = static_cast<size_t>(place);
    const double t = place - static_cast<double>(i);
    const double before = nodes_[i], at = nodes_[i + 1], next = nodes_[i + 2],
                 after = nodes_[i + 3];
    return -t * (t - 1) * (t - 2) / 6 * before + (t + 1) * (t - 1) * (t - 2) / 2 * at -
           (t + 1) * t * (t - 2) / 2 * next + (t + 1) * t * (t - 1) / 6 * after;
  }

 private:
  // The cubic's error is 3/128 of the fourth derivative over 48^4: 2e-8 at a blur of 0.5 px.
  static constexpr int kPerPx = 48;
  double reach_px_;
  std::vector<double> nodes_;  // from one spacing before -reach_px_
};

}  // namespace

double Gaussian::operator()() {
  const double u = Uniform(), v = Uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

cv::Mat HalfPlaneCoverage(cv::Size size,
                          const Eigen::Vector2d& normal,
                          double offset,
                          double blur_px) {
  cv::Mat coverage(size, CV_64F);
  const PixelProfile profile(normal, blur_px);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      coverage.at<double>(y, x) = profile.At(normal.x() * x + normal.y() * y - offset);
  }
  return coverage;
}

cv::Mat DiskCoverage(cv::Size size, const Eigen::Vector2d& center, double radius, double blur_px) {
  cv::Mat coverage(size, CV_64F);
  const double reach = 7 * blur_px + 0.75;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double d = std::hypot(x - center.x(), y - center.y()) - radius;
      double value = d > 0 ? 1 : 0;
      if (std::abs(d) < reach) {
        // Chords of the disk along x, weighted by the point spread along y; t turns the arc's ends
        // into a smooth integrand where the disk begins or ends within reach.
        const double low = std::max(y - reach, center.y() - radius),
                     high = std::min(y + reach, center.y() + radius);
        const double from = std::asin(std::clamp((low - center.y()) / radius, -1.0, 1.0));
        const double to = std::asin(std::clamp((high - center.y()) / radius, -1.0, 1.0));
        const double disk = Integrate(from, to, 8, [&](double t) {
          const double row = center.y() + radius * std::sin(t), half = radius * std::cos(t);
          return half * BoxedDensity(row - y, blur_px) *
                 (BoxedCdf(center.x() + half - x, blur_px) -
                  BoxedCdf(center.x() - half - x, blur_px));
        });
        value = 1 - disk;
      }
      coverage.at<double>(y, x) = value;
    }
  }
  return coverage;
}

cv::Mat Stored(const cv::Mat& light, double noise, double gamma, Gaussian& random) {
  cv::Mat stored(light.size(), CV_8U);
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      const double exposed = std::clamp(light.at<double>(y, x) / 255, 0.0, 1.0);
      const double encoded =
          255 * std::pow(exposed, 1 / gamma) + (noise > 0 ? noise * random() : 0.0);
      stored.at<uchar>(y, x) = static_cast<uchar>(std::clamp(std::lround(encoded), 0L, 255L));
    }
  }
  return stored;
}

cv::Mat Photographed(const cv::Mat& coverage, const EdgeLook& look, Gaussian& noise) {
  const cv::Mat light = look.blade + (look.ground - look.blade) * coverage;
  return Stored(light, look.noise, look.gamma, noise);
}

ToneCurve GammaCurve(double gamma) {
  ToneCurve tone;
  for (size_t v = 0; v < tone.linear.size(); ++v) {
    tone.linear[v] = static_cast<float>(std::pow(static_cast<double>(v) / 255, gamma));
  }
  return tone;
}

}  // namespace bladecurve::testing
