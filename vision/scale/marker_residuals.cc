// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_residuals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/image/robust_statistics.h"

namespace bladecurve {

MarkerResiduals::MarkerResiduals(const std::vector<MarkerPixel>& pixels,
                                 const InkCells& ink,
                                 const MarkerFrame& frame,
                                 const MarkerVector& at) {
  constexpr double kPlainWhite = 0.05, kSofter = 1.2;
  MarkerVector soft = at;
  soft[kBlur] *= kSofter;
  const MarkerModel model(ink, frame, at), softer(ink, frame, soft);
  MarkerVector derivative, derivative_softer;
  Vector derivatives;
  for (const MarkerPixel& pixel : pixels) {
    Cell& cell = cells_[static_cast<size_t>(pixel.cell)];
    const double light = model.Light(pixel.place, &derivative);
    const double residual = pixel.light - light;
    if (light >= 1 && residual > -kPlainWhite) continue;  // says nothing
    (void)softer.Light(pixel.place, &derivative_softer);
    derivatives << derivative, derivative_softer[kBlur] - derivative[kBlur];
    const double to_exponent = light > 0 && light < 1 ? -light * std::log(light) : 0;
    cell.sum_square += residual * residual;
    cell.score += residual * derivatives;
    cell.tone_score += residual * to_exponent;
    ++cell.count;
    information_.noalias() += derivatives * derivatives.transpose();
    tone_cross_ += to_exponent * derivatives;
    tone_information_ += to_exponent * to_exponent;
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

ToneSeen MarkerResiduals::Tone() const {
  // What of the derivatives to the exponent the other unknowns cannot do.
  const Vector shared = information_.ldlt().solve(tone_cross_);
  const double own_information = tone_information_ - tone_cross_.dot(shared);
  double score = 0, count = 0, cells = 0;
  for (const Cell& cell : cells_) {
    score += cell.tone_score - shared.dot(cell.score);
    count += cell.count;
    cells += cell.count > 0 ? 1 : 0;
  }
  if (!(own_information > 0) || cells < 2) return {};
  double square = 0;  // of what each cell leaves
  for (const Cell& cell : cells_) {
    const double left = cell.tone_score - shared.dot(cell.score) - score * cell.count / count;
    square += left * left;
  }
  return {1 + score / own_information, std::sqrt(square * cells / (cells - 1)) / own_information};
}

MarkerMatrix MarkerResiduals::Covariance(const MarkerMatrix& information) const {
  MarkerMatrix middle = MarkerMatrix::Zero();
  double cells = 0;
  for (const Cell& cell : cells_) {
    const auto score = cell.score.head<kMarkerUnknowns>();
    middle += score * score.transpose();
    cells += cell.count > 0 ? 1 : 0;
  }
  const MarkerMatrix inverse = information.ldlt().solve(MarkerMatrix::Identity());
  const double correction = cells / std::max(1.0, cells - double{kMarkerUnknowns});
  return correction * inverse * middle * inverse;
}

}  // namespace bladecurve
