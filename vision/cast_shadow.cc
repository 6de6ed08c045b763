// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/cast_shadow.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/pixel_light.h"
#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

// Typical light at a distance from an edge, positive out of the blade; 0 beyond the picture. Not
// near the crotch, where the other blade is close.
double TypicalLight(const cv::Mat& grey,
                    const ToneCurve& tone,
                    const LocatedEdge& edge,
                    double across_px) {
  constexpr double kFirst = 0.15;      // of the points
  constexpr std::size_t kEnough = 60;  // places along the edge
  const std::size_t count = edge.points.size(), stride = 1 + count / kEnough;
  std::vector<double> light;
  for (auto i = static_cast<std::size_t>(kFirst * static_cast<double>(count)); i < count;
       i += stride) {
    const LocatedEdgePoint& point = edge.points[i];
    if (const auto at = LightAt(grey, tone, point.trend_px + across_px * point.normal))
      light.push_back((*at)[0]);
  }
  return light.empty() ? 0 : Median(std::move(light));
}

bool WithinFactor(double a, double b, double factor) { return a < factor * b && b < factor * a; }

}  // namespace

std::optional<DarkMargin> FindDarkMargin(const cv::Mat& grey,
                                         const ToneCurve& tone,
                                         const LocatedEdge& edge,
                                         double blade_px) {
  constexpr double kNearestPx = 2, kDarkestPx = 4;  // from the edge, whose blur ends there
  constexpr double kGroundPx = 4, kGroundEndPx = 10;
  constexpr double kWidest = 0.5;                // of the blade
  constexpr double kDarker = 1.5;                // times lighter is the ground,
  constexpr double kRises = 1.2, kPlate = 1.25;  // light where the margin ends, and behind
  constexpr double kBehindPx = 6;
  constexpr double kStep = 0.1;  // of the width
  const auto light_at = [&](double across) { return TypicalLight(grey, tone, edge, across); };
  std::vector<double> ground;
  for (double across = kGroundPx; across <= kGroundEndPx; ++across)
    ground.push_back(light_at(across));
  DarkMargin margin{0, light_at(-kNearestPx), Median(std::move(ground))};
  for (double across = kNearestPx + 1; across <= kDarkestPx; ++across)
    margin.light = std::min(margin.light, light_at(-across));
  if (margin.light <= 0 || margin.ground < kDarker * margin.light) return std::nullopt;
  const double widest = std::max(kWidest * blade_px, kDarkestPx + kBehindPx);
  margin.width_px = kNearestPx;
  while (margin.width_px < widest && light_at(-margin.width_px) < kRises * margin.light)
    margin.width_px += std::max(1.0, kStep * margin.width_px);
  for (double behind = 0; behind <= kBehindPx; ++behind) {
    const bool in_reach = margin.width_px + behind <= widest;
    if (in_reach && light_at(-margin.width_px - behind) > kPlate * margin.light) return margin;
  }
  return std::nullopt;
}

bool AreOneShadow(const DarkMargin& a, const DarkMargin& b) {
  constexpr double kSameLight = 1.12, kSameGround = 1.06, kSameWidth = 2;
  return WithinFactor(a.light, b.light, kSameLight) &&
         WithinFactor(a.ground, b.ground, kSameGround) &&
         WithinFactor(a.width_px, b.width_px, kSameWidth);
}

}  // namespace bladecurve
