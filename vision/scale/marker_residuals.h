// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "vision/scale/marker_model.h"
#include "vision/scale/marker_pixels.h"

namespace bladecurve {

// What a fit leaves of the pixels' light, cell by cell of the marker. Pixels in plain white that
// are white in the fit as well say nothing and do not count.
class MarkerResiduals {
 public:
  MarkerResiduals(const std::vector<MarkerPixel>& pixels, const MarkerModel& model);

  // Without the cells that something lies over: they fit far worse than the typical one.
  [[nodiscard]] std::vector<MarkerPixel> Uncovered(std::vector<MarkerPixel> pixels) const;

  // Whether of the light that the pixels differ by, most is the pattern's.
  [[nodiscard]] bool Explain(const std::vector<MarkerPixel>& pixels) const;

  // Of the fit: sandwich estimate with the cells as clusters, since within them the noise may be
  // correlated, and what the model lacks is alike. `information` as in MarkerMinimum.
  [[nodiscard]] MarkerMatrix Covariance(const MarkerMatrix& information) const;

 private:
  struct Cell {
    double sum_square = 0;
    int count = 0;
    MarkerVector score = MarkerVector::Zero();
  };
  std::array<Cell, MarkerModel::kCellsAcross * MarkerModel::kCellsAcross> cells_;
};

}  // namespace bladecurve
