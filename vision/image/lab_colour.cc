// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/lab_colour.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "vision/parallel.h"

namespace bladecurve {
namespace {

double FromSrgb(double encoded) {  // IEC 61966-2-1
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Of CIE 15, (8.6): the cube root, with a straight line where it would be too steep.
double Lightness(double share) {
  constexpr double kStraightBelow = 216.0 / 24389, kSlope = 24389.0 / (27 * 116);
  return share > kStraightBelow ? std::cbrt(share) : kSlope * share + 16.0 / 116;
}

Eigen::Array4f LabOf(double red, double green, double blue) {  // linear
  // IEC 61966-2-1, each of X, Y, Z over that of white.
  const double x = Lightness(0.433953 * red + 0.376219 * green + 0.189828 * blue),
               y = Lightness(0.212671 * red + 0.715160 * green + 0.072169 * blue),
               z = Lightness(0.017758 * red + 0.109477 * green + 0.872766 * blue);
  return {static_cast<float>(116 * y - 16),
          static_cast<float>(500 * (x - y)),
          static_cast<float>(200 * (y - z)),
          0};
}

// L*a*b* at 33 levels of each colour, linear between them, sixteen steps from one to the next.
class LabTable {
 public:
  LabTable() {
    std::array<double, kLevels> linear{};
    for (std::size_t i = 0; i < kLevels; ++i)
      linear[i] = FromSrgb(static_cast<double>(i) / (kLevels - 1));
    nodes_.reserve(kLevels * kLevels * kLevels);
    for (const double blue : linear) {
      for (const double green : linear) {
        for (const double red : linear) nodes_.push_back(LabOf(red, green, blue));
      }
    }
    for (std::size_t value = 0; value < places_.size(); ++value) {
      const std::size_t step = (value * kWhite + 127) / 255 * kSteps * (kLevels - 1) / kWhite;
      // The last level counts as the end of the cell before it.
      const std::size_t level = std::min(step / kSteps, kLevels - 2);
      places_[value] = {level, static_cast<float>(step - level * kSteps) / kSteps};
    }
  }

  // L*, a*, b*, 0: four are computed as quickly as three.
  using Node = Eigen::Array4f;

  [[nodiscard]] Node At(const cv::Vec3b& bgr) const {
    const Place &blue = places_[bgr[0]], &green = places_[bgr[1]], &red = places_[bgr[2]];
    const Node* const node = &nodes_[(blue.level * kLevels + green.level) * kLevels + red.level];
    return Between(Between(Along(node, red), Along(node + kLevels, red), green.share),
                   Between(Along(node + kLevels * kLevels, red),
                           Along(node + kLevels * kLevels + kLevels, red),
                           green.share),
                   blue.share);
  }

 private:
  static constexpr std::size_t kLevels = 33, kSteps = 16, kWhite = 1 << 14;

  struct Place {
    std::size_t level = 0;
    float share = 0;  // of the way to the next level
  };

  static Node Between(const Node& from, const Node& to, float share) {
    return from + share * (to - from);
  }
  static Node Along(const Node* node, const Place& red) {
    return Between(node[0], node[1], red.share);
  }

  std::vector<Node> nodes_;          // red runs quickest, then green
  std::array<Place, 256> places_{};  // of stored values
};

}  // namespace

cv::Mat LabFromBgr(const cv::Mat& bgr) {
  if (bgr.type() != CV_8UC3) throw std::invalid_argument("LabFromBgr: picture must be CV_8UC3");
  static const LabTable table;
  cv::Mat lab(bgr.size(), CV_32FC3);
  ParallelForBands(bgr.rows, [&](int first, int last) {
    for (int row = first; row < last; ++row) {
      const auto* const pixels = bgr.ptr<cv::Vec3b>(row);
      auto* const out = lab.ptr<cv::Vec3f>(row);
      for (int column = 0; column < bgr.cols; ++column) {
        const LabTable::Node node = table.At(pixels[column]);
        out[column] = {node[0], node[1], node[2]};
      }
    }
  });
  return lab;
}

}  // namespace bladecurve
