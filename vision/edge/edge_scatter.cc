// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "vision/edge/edge_curve.h"
#include "vision/edge/edge_path.h"
#include "vision/image/robust_statistics.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

constexpr double kMostBlur = 5;  // px; beyond, the position is a matter of taste

constexpr double kTrendPx = 60;  // what bends over less is scatter

// Neighbouring slices combined by their information.
std::vector<LocatedEdgePoint> SeenOf(const EdgeFit& fit) {
  std::vector<LocatedEdgePoint> points;
  for (const EdgeSlice& slice : fit.slices) {
    if (!std::isfinite(slice.sigma_px)) continue;
    const size_t sample = Index(slice.sample);
    LocatedEdgePoint point;
    point.normal = fit.path.normals[sample];
    point.point_px = fit.path.points[sample] + slice.offset_px * point.normal;
    point.sigma_px = slice.sigma_px;
    point.contrast = slice.contrast;
    points.push_back(point);
  }
  return points;
}

void SetTrend(double spacing_px, double length_px, std::vector<LocatedEdgePoint>& points) {
  std::vector<double> x, y, weights;
  for (const LocatedEdgePoint& point : points) {
    x.push_back(point.point_px.x());
    y.push_back(point.point_px.y());
    weights.push_back(point.inlier ? 1 / (point.sigma_px * point.sigma_px) : 0.0);
  }
  const double stiffness = std::max(Median(weights), 1e-6) *
                           std::pow(length_px / spacing_px / (2 * std::numbers::pi), 4);
  x = SmoothValues(x, weights, stiffness);
  y = SmoothValues(y, weights, stiffness);
  for (size_t i = 0; i < points.size(); ++i) points[i].trend_px = {x[i], y[i]};
}

// The trend of all inlying points, and how far each lies off it, in its own sigmas.
std::vector<double> Detrend(std::vector<LocatedEdgePoint>& points, double spacing_px) {
  SetTrend(spacing_px, kTrendPx, points);
  std::vector<double> scatter;
  for (const LocatedEdgePoint& p : points)
    scatter.push_back(p.normal.dot(p.point_px - p.trend_px) / p.sigma_px);
  return scatter;
}

// Points that leave the plain curve of the others.
void RejectStrays(std::vector<LocatedEdgePoint>& points) {
  constexpr double kTolerance = 0.3;  // px; what a blade may differ from the curve
  constexpr double kSpreads = 4;
  const std::vector<double> distances = DistancesFromPlainCurve(points);
  const double limit = kTolerance + kSpreads * MedianAbsolute(distances);
  for (size_t i = 0; i < points.size(); ++i) points[i].inlier = std::abs(distances[i]) <= limit;
}

// Texture, roughness and compression scatter the points more than the pixels' noise: how much more.
double ExcessOf(const std::vector<double>& scatter) {
  return std::max(1.0, kSigmaPerMedian * MedianAbsolute(scatter));
}

// Sum of the correlations of neighbours: how many points count as one. Ends where they are no more
// than what independent points reach by chance, which is 1/sqrt(count).
double PointsPerIndependentOne(const std::vector<double>& normalized) {
  constexpr size_t kMostLag = 40;
  constexpr double kFirstByChance = 3, kNextByChance = 1.5;
  const double chance = 1 / std::sqrt(std::max(static_cast<double>(normalized.size()), 1.0));
  double variance = 0, sum = 1;
  for (const double value : normalized) variance += value * value;
  for (size_t lag = 1; lag <= std::min(kMostLag, normalized.size() / 3); ++lag) {
    double product = 0;
    for (size_t i = lag; i < normalized.size(); ++i) product += normalized[i] * normalized[i - lag];
    const double correlation = product / std::max(variance, 1e-30);
    if (correlation < chance * (lag == 1 ? kFirstByChance : kNextByChance)) break;
    sum += 2 * correlation;
  }
  return sum;
}

// Where points scatter more than usual, more of them tell where the edge runs.
void SmoothNoisyTrend(double spacing_px, std::vector<LocatedEdgePoint>& points) {
  constexpr double kUsual = 0.3;       // px, of a point
  constexpr double kMostOfEdge = 0.5;  // blades bend over no less
  const double edge_px = spacing_px * static_cast<double>(points.size());
  const double length_px =
      std::min(kMostOfEdge * edge_px, kTrendPx * TypicalSigma(points) / kUsual);
  if (length_px > kTrendPx) SetTrend(spacing_px, length_px, points);
}

}  // namespace

LocatedEdge PointsFromFit(const EdgeFit& fit) {
  if (fit.blur_px > kMostBlur) {
    throw Refused(Reason::kBlurred,
                  "edge: blurred over " + std::to_string(std::lround(fit.blur_px)) +
                      " px; focus on the blades or hold the camera still");
  }
  constexpr int kPasses = 3;          // without the worst outliers the next stand out
  constexpr double kStraySigmas = 4;  // further off the local edge lie glints, nicks and dirt
  const int spacing_px = fit.spacing;
  LocatedEdge edge;
  edge.points = SeenOf(fit);
  RejectStrays(edge.points);
  std::vector<double> scatter;
  double excess = 1;
  for (int pass = 0; pass < kPasses; ++pass) {
    scatter = Detrend(edge.points, spacing_px);
    excess = ExcessOf(scatter);
    for (size_t i = 0; i < scatter.size(); ++i) {
      edge.points[i].inlier &= std::abs(scatter[i]) <= kStraySigmas * excess;
    }
  }
  if (RejectDetachedEnds(edge.points)) scatter = Detrend(edge.points, spacing_px);
  std::vector<double> inlying;
  for (size_t i = 0; i < scatter.size(); ++i) {
    edge.points[i].sigma_px *= excess;
    if (edge.points[i].inlier) inlying.push_back(scatter[i]);
  }
  SmoothNoisyTrend(spacing_px, edge.points);
  edge.correlation_px = PointsPerIndependentOne(inlying) * spacing_px;
  edge.blur_px = fit.blur_px;
  edge.unbound_blur_px = fit.unbound_blur_px;
  return edge;
}

}  // namespace bladecurve
