// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "vision/scale/marker_model.h"
#include "vision/scale/marker_pixels.h"
#include "vision/scale/scale.h"

namespace bladecurve {

// What a fit leaves of the pixels' light, cell by cell of the marker. Pixels in plain white that
// are white in the fit as well say nothing and do not count.
class MarkerResiduals {
 public:
  MarkerResiduals(const std::vector<MarkerPixel>& pixels,
                  const InkCells& ink,
                  const MarkerFrame& frame,
                  const MarkerVector& at);

  // Without the cells that something lies over: they fit far worse than the typical one.
  [[nodiscard]] std::vector<MarkerPixel> Uncovered(std::vector<MarkerPixel> pixels) const;

  // Whether of the light that the pixels differ by, most is the pattern's.
  [[nodiscard]] bool Explain(const std::vector<MarkerPixel>& pixels) const;

  // What the way from ink to paper tells of the tone curve. A blurred border is alike on both sides
  // in linear light alone; read with a wrong exponent it is longer on one of them. To first order
  // about the fit, and whatever the kurtosis of the blur, which is alike on both sides.
  [[nodiscard]] ToneSeen Tone() const;

  // Of the fit: sandwich estimate with the cells as clusters, since within them the noise may be
  // correlated, and what the model lacks is alike. `information` as in MarkerMinimum.
  [[nodiscard]] MarkerMatrix Covariance(const MarkerMatrix& information) const;

 private:
  // The unknowns, and how much faster or slower than a Gaussian's the tails of the blur fall.
  static constexpr int kUnknowns = kMarkerUnknowns + 1;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

  struct Cell {
    double sum_square = 0;
    int count = 0;
    Vector score = Vector::Zero();
    double tone_score = 0;
  };
  std::array<Cell, MarkerModel::kCellsAcross * MarkerModel::kCellsAcross> cells_;
  // Sums of products of the derivatives: to the unknowns, to the exponent, to both.
  Matrix information_ = Matrix::Zero();
  double tone_information_ = 0;
  Vector tone_cross_ = Vector::Zero();
};

}  // namespace bladecurve
