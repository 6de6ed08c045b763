// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/light_along.h"

#include <utility>
#include <vector>

#include "vision/image/pixel_light.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {

std::optional<double> TypicalLight(const cv::Mat& grey,
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
  return light.empty() ? std::nullopt : std::optional(Median(std::move(light)));
}

}  // namespace bladecurve
