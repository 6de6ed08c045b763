// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_residuals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "vision/image/robust_statistics.h"

namespace bladecurve {

MarkerResiduals::MarkerResiduals(const std::vector<MarkerPixel>& pixels, const MarkerModel& model) {
  constexpr double kPlainWhite = 0.05;
  MarkerVector derivative;
  for (const MarkerPixel& pixel : pixels) {
    Cell& cell = cells_[static_cast<size_t>(pixel.cell)];
    const double light = model.Light(pixel.place, &derivative);
    const double residual = pixel.light - light;
    if (light >= 1 && residual > -kPlainWhite) continue;  // says nothing
    cell.sum_square += residual * residual;
    cell.score += residual * derivative;
    ++cell.count;
  }
}

std::vector<MarkerPixel> MarkerResiduals::Uncovered(std::vector<MarkerPixel> pixels) const {
  constexpr double kFarWorse = 9;  // of mean squares
  std::vector<double> means;
  for (const Cell& cell : cells_) {
    if (cell.count > 0) means.push_back(cell.sum_square / cell.count);
  }
  if (means.empty()) return {};
  const double most = kFarWorse * Median(std::move(means));
  std::erase_if(pixels, [&](const MarkerPixel& pixel) {
    const Cell& cell = cells_[static_cast<size_t>(pixel.cell)];
    return cell.sum_square > most * cell.count;
  });
  return pixels;
}

bool MarkerResiduals::Explain(const std::vector<MarkerPixel>& pixels) const {
  constexpr double kMostLeft = 0.1;
  double sum = 0, square = 0, left = 0;
  for (const MarkerPixel& pixel : pixels) {
    sum += pixel.light;
    square += pixel.light * pixel.light;
  }
  for (const Cell& cell : cells_) left += cell.sum_square;
  return left < kMostLeft * (square - sum * sum / static_cast<double>(pixels.size()));
}

MarkerMatrix MarkerResiduals::Covariance(const MarkerMatrix& information) const {
  MarkerMatrix middle = MarkerMatrix::Zero();
  double cells = 0;
  for (const Cell& cell : cells_) {
    middle += cell.score * cell.score.transpose();
    cells += cell.count > 0 ? 1 : 0;
  }
  const MarkerMatrix inverse = information.ldlt().solve(MarkerMatrix::Identity());
  const double correction = cells / std::max(1.0, cells - double{kMarkerUnknowns});
  return correction * inverse * middle * inverse;
}

}  // namespace bladecurve
