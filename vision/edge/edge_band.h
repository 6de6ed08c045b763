// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge_path.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// One raw pixel beside a path.
struct BandPixel {
  float across = 0;  // signed distance of its centre from the path, px, positive out of the blade
  float light = 0;   // linear light, 0 to 1
};

// The raw pixels within reach of a path, grouped by the path sample they are nearest to; each pixel
// once.
struct PixelBand {
  std::vector<BandPixel> pixels;
  std::vector<int> begin;  // pixels of sample i: [begin[i], begin[i + 1])

  [[nodiscard]] int size() const { return static_cast<int>(begin.size()) - 1; }
};

// How far a band goes on either side of each sample of its path, px.
struct BandReach {
  std::vector<double> inner_px, outer_px;
};

[[nodiscard]] PixelBand GatherPixels(const cv::Mat& grey,
                                     const ToneCurve& tone,
                                     const EdgePath& path,
                                     const BandReach& reach);

// Linear light on a grid along and across a path, by bilinear interpolation: rows across, columns
// along.
struct StraightBand {
  int columns = 0, rows = 0;
  double first_across_px = 0,
         across_step_px = 1;  // row r lies at first_across_px + r * across_step_px
  std::vector<float> light;   // [column * rows + row]; NaN outside the picture

  [[nodiscard]] const float* Column(int column) const {
    return &light[static_cast<size_t>(column) * static_cast<size_t>(rows)];
  }
  [[nodiscard]] double Across(double row) const { return first_across_px + row * across_step_px; }
};

[[nodiscard]] StraightBand StraightenBand(const cv::Mat& grey,
                                          const ToneCurve& tone,
                                          const EdgePath& path,
                                          double inner_px,
                                          double outer_px);

}  // namespace bladecurve
