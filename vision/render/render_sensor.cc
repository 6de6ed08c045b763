// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_sensor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/render/render_noise.h"

namespace bladecurve::render {
namespace {

// Encode() times 255 from a table, as twelve million powers take seconds. Nodes lie at (i / n)^2,
// dense in the dark where the curve is steep; the error is below 1e-3 grey levels.
class EncodeTable {
 public:
  explicit EncodeTable(const SensorSpec& sensor) {
    for (int i = 0; i <= kNodes + 1; ++i) {
      const double root = static_cast<double>(i) / kNodes;
      values_.push_back(static_cast<float>(255 * Encode(root * root, sensor)));
    }
  }

  [[nodiscard]] float At(float linear) const {
    const float place = std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * kNodes;
    const auto node = static_cast<std::size_t>(place);
    const float share = place - static_cast<float>(node);
    return values_[node] * (1 - share) + values_[node + 1] * share;
  }

 private:
  static constexpr int kNodes = 4096;
  std::vector<float> values_;
};

}  // namespace

double Encode(double linear, const SensorSpec& sensor) {
  const double x = std::clamp(linear, 0.0, 1.0);
  if (!sensor.srgb) return std::pow(x, 1 / sensor.gamma);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

cv::Mat3b Develop(const cv::Mat3f& linear_rgb, const SensorSpec& sensor, std::uint64_t seed) {
  const EncodeTable table(sensor);
  cv::Mat3b bgr(linear_rgb.size());
  for (int r = 0; r < bgr.rows; ++r) {
    for (int c = 0; c < bgr.cols; ++c) {
      const cv::Vec3f& light = linear_rgb(r, c);
      const float noise =
          sensor.noise_grey > 0 ? static_cast<float>(sensor.noise_grey * NormalAt(seed, c, r)) : 0;
      for (int i = 0; i < 3; ++i)
        bgr(r, c)[2 - i] = cv::saturate_cast<uchar>(table.At(light[i]) + noise);
    }
  }
  return bgr;
}

}  // namespace bladecurve::render
