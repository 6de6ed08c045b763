// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/image/tone_curve.h"
#include "vision/scale/straight_edge.h"

namespace bladecurve {

// Stored grey values and the light they stand for.
struct LinearPicture {
  const cv::Mat& grey;
  const ToneCurve& tone;
};

// A line, or an arc of a small sagitta, and the band about it.
struct StraightEdgeBand {
  Eigen::Vector2d middle, direction, normal;
  double length, half_width, bow;
};

// The band about a guess.
[[nodiscard]] StraightEdgeBand MakeBand(const StraightEdgeGuess& guess, double half_width);

// How far the arc lies off its chord, along the normal.
[[nodiscard]] double Sagitta(const StraightEdgeBand& band, double along);

// A pixel of a band.
struct BandSample {
  double across, along;  // px from the middle of the guess
  double light;          // linear, 0 to 1
  int bin;
};

// The pixels of the band, column by column if it lies flat, row by row if it is steep. `stride`
// thins them out.
[[nodiscard]] std::vector<BandSample> Collect(const LinearPicture& picture,
                                              const StraightEdgeBand& band,
                                              int stride);

// How many pieces along the edge BandSample::bin tells apart.
[[nodiscard]] size_t BinCount(const StraightEdgeBand& band);

}  // namespace bladecurve
