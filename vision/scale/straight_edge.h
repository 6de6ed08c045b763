// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// Of straight edges that are believed.
inline constexpr double kMinBlurPx =
    0.2;  // sharper than any lens and pixel; below, the blur has no effect left
inline constexpr double kMaxBlurPx = 6;  // rejects shadows and gradients

// Where a straight edge between a dark and a bright area runs, to within search_px.
struct StraightEdgeGuess {
  Eigen::Vector2d from_px, to_px;  // ends of the piece to use
  double search_px = 2;            // how far off the guess may be
  double free_px = 6;              // to the next edge on either side: wider bands would see it
  double bow_px =
      0;  // the lens bends the edge: its middle lies this far off the chord, along (-dy, dx)
};

// The edge as a chord: at `along` px from `middle_px` it lies bow_px (1 - (2 along / length)^2) off
// the line.
struct StraightEdge {
  Eigen::Vector2d middle_px;  // of the chord
  Eigen::Vector2d direction;  // unit, from the guess's first end to its second
  double length_px = 0, bow_px = 0;
  Eigen::Matrix2d
      covariance;      // of the offset along (-dy, dx), px, and of the direction's angle, rad
  double blur_px = 0;  // Gaussian sigma, pixel box apart
  double noise = 0;    // rms of a pixel about the model, linear light
  double contrast =
      0;  // bright minus dark, linear light, signed: positive if bright lies along (-dy, dx)
  double bright = 0;  // light of the bright side; white is 1, and what is brighter stored as white
  double used =
      1;  // share of the length that agrees with a straight edge; the rest is covered or dirty

  [[nodiscard]] Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
};

// Maximum likelihood on the raw pixels of a band along the edge: blurred step, averaged over each
// pixel, with free levels, blur and illumination slopes; the noise is taken as even in stored grey
// values. Pieces along the edge that do not fit are left out. std::nullopt if there is no such
// edge.
[[nodiscard]] std::optional<StraightEdge> LocateStraightEdge(const cv::Mat& grey,
                                                             const ToneCurve& tone,
                                                             const StraightEdgeGuess& guess);

// Where two such edges cross, with the covariance in px^2.
struct EdgeCrossing {
  Eigen::Vector2d point_px;
  Eigen::Matrix2d covariance_px2;
};
[[nodiscard]] EdgeCrossing Cross(const StraightEdge& first, const StraightEdge& second);

}  // namespace bladecurve
