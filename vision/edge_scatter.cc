// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "vision/blurred_step.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

constexpr int kLeastPoints = 12;  // fewer do not tell a line from a curve
constexpr double kMostBlur = 5;   // px; beyond, the position is a matter of taste

size_t Index(int i) { return static_cast<size_t>(i); }

double MedianAbsolute(std::vector<double> values) {
  if (values.empty()) return 0;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Neighbouring slices combined by their information; the slices are about a pixel long.
std::vector<LocatedEdgePoint> Combined(const EdgeFit& fit,
                                       int slices_per_point,
                                       std::vector<double>& scatter) {
  std::vector<LocatedEdgePoint> points;
  for (int first = 0; first < fit.path.size(); first += slices_per_point) {
    const int last = std::min(first + slices_per_point, fit.path.size());
    double information = 0, offset = 0, contrast = 0, rest = 0;
    for (int i = first; i < last; ++i) {
      const EdgeSlice& slice = fit.slices[Index(i)];
      if (!std::isfinite(slice.sigma_px)) continue;
      const double weight = 1 / (slice.sigma_px * slice.sigma_px);
      information += weight;
      offset += weight * slice.offset_px;
      rest += weight * (slice.offset_px - fit.trend_px[Index(i)]);
      contrast += weight * slice.contrast;
    }
    if (information <= 0) continue;
    const size_t middle = Index((first + last - 1) / 2);
    LocatedEdgePoint point;
    point.normal = fit.path.normals[middle];
    point.point_px = fit.path.points[middle] + offset / information * point.normal;
    point.trend_px = fit.path.points[middle] + fit.trend_px[middle] * point.normal;
    point.sigma_px = 1 / std::sqrt(information);
    point.contrast = contrast / information;
    points.push_back(point);
    scatter.push_back(rest / information);
  }
  return points;
}

// Sum of the correlations of neighbours, up to the first that is not positive: how many points
// count as one.
double PointsPerIndependentOne(const std::vector<double>& normalized) {
  constexpr size_t kMostLag = 40;
  double variance = 0;
  for (const double value : normalized) variance += value * value;
  double sum = 1;
  for (size_t lag = 1; lag <= std::min(kMostLag, normalized.size() / 3); ++lag) {
    double product = 0;
    for (size_t i = lag; i < normalized.size(); ++i) product += normalized[i] * normalized[i - lag];
    // What independent points reach by chance is no correlation.
    const double correlation = product / std::max(variance, 1e-30);
    if (correlation < 1.5 / std::sqrt(static_cast<double>(normalized.size()))) break;
    sum += 2 * correlation;
  }
  return sum;
}

}  // namespace

LocatedEdge PointsFromFit(const EdgeFit& fit, const EdgeOptions& options) {
  if (fit.blur_px > kMostBlur) {
    throw Refused(Reason::kBlurred,
                  "edge: blurred over " + std::to_string(std::lround(fit.blur_px)) +
                      " px; focus on the blades or hold the camera still");
  }
  const int slices_per_point = std::max(1, static_cast<int>(std::lround(options.step_px)));
  LocatedEdge edge;
  std::vector<double> scatter;
  edge.points = Combined(fit, slices_per_point, scatter);
  if (static_cast<int>(edge.points.size()) < kLeastPoints) {
    throw Refused(Reason::kEdgeTooShort,
                  "edge: " + std::to_string(edge.points.size()) +
                      " points are too few; photograph from nearer");
  }
  for (size_t i = 0; i < scatter.size(); ++i) scatter[i] /= edge.points[i].sigma_px;
  // Texture, roughness and compression scatter the points more than the pixels' noise: say what is
  // seen.
  constexpr double kSigmaPerMedian = 1.4826;
  const double excess = std::max(1.0, kSigmaPerMedian * MedianAbsolute(scatter));
  std::vector<double> inlying;
  for (size_t i = 0; i < scatter.size(); ++i) {
    edge.points[i].sigma_px *= excess;
    edge.points[i].inlier = std::abs(scatter[i]) <= options.outlier_sigmas * excess;
    if (edge.points[i].inlier) inlying.push_back(scatter[i]);
  }
  edge.correlation_px = PointsPerIndependentOne(inlying) * slices_per_point;
  edge.blur_px = fit.blur_px;
  edge.noise =
      std::sqrt(0.5 * (fit.noise_blade * fit.noise_blade + fit.noise_ground * fit.noise_ground));
  return edge;
}

double ToneSigma(const EdgeFit& fit, const ToneCurve& tone) {
  constexpr double kUsualGamma = 2.2, kDarkest = 0.004;  // one grey level of sRGB
  std::vector<double> shifts;
  const double exponent = 1 + tone.gamma_sigma / kUsualGamma;
  for (const EdgeSlice& slice : fit.slices) {
    const double ground = std::clamp(slice.ground, kDarkest, 1.0),
                 blade = std::clamp(slice.ground - slice.contrast, kDarkest, 1.0);
    // Light that is taken for half-way between the two levels when the exponent is off by one
    // sigma.
    const double half =
        std::pow(0.5 * (std::pow(ground, exponent) + std::pow(blade, exponent)), 1 / exponent);
    const double slope =
        std::abs(ground - blade) / std::sqrt(2 * std::numbers::pi * TotalBlurVariance(fit.blur_px));
    shifts.push_back((half - 0.5 * (ground + blade)) / std::max(slope, 1e-3));
  }
  return MedianAbsolute(std::move(shifts));
}

}  // namespace bladecurve
