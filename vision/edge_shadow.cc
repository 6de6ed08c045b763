// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_shadow.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/chroma.h"
#include "vision/pixel_light.h"
#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Typical colour along an edge at `from`..`to` px from it, positive out of the blade.
std::optional<Chroma> ChromaAlong(
    const cv::Mat& bgr, const ToneCurve& tone, const LocatedEdge& edge, double from, double to) {
  constexpr std::size_t kStride = 2, kFewest = 20;
  std::vector<double> blue, red;
  for (std::size_t i = 0; i < edge.points.size(); i += kStride) {
    const LocatedEdgePoint& point = edge.points[i];
    for (double across = from; across <= to; ++across) {
      const auto light = LightAt(bgr, tone, point.trend_px + across * point.normal);
      if (!light) continue;
      const Chroma chroma = ChromaOf(*light);
      blue.push_back(chroma[0]);
      red.push_back(chroma[1]);
    }
  }
  if (blue.size() < kFewest) return std::nullopt;
  return Chroma(Median(std::move(blue)), Median(std::move(red)));
}

}  // namespace

DarkBand JudgeDarkBand(const cv::Mat& bgr,
                       const ToneCurve& tone,
                       const LocatedEdge& edge,
                       double blade_px) {
  constexpr double kBlur = 1.5;                    // px; nearer to a step both sides mix
  constexpr double kDeepest = 0.45, kDeep = 0.25;  // of the blade's width, from the inner step
  constexpr double kToldApart = 0.15;              // chromas nearer than that are not
  constexpr double kShadow = 0.45, kMetal = 0.6;   // of the way from background to blade
  constexpr double kBleedPx = 5;  // colours are stored at half the resolution: bright metal lends a
                                  // narrow dark band its own, but no more than that
  constexpr double kScatter = 0.05;  // of chromas: skylight, colours that bleed
  const double inner = std::min(edge.rival_px, 0.0), outer = std::max(edge.rival_px, 0.0);
  const double width = outer - inner;
  const auto band = ChromaAlong(bgr, tone, edge, inner + kBlur, outer - kBlur);
  const auto ground = ChromaAlong(bgr, tone, edge, outer + kBlur + 1, outer + kBlur + 1 + width);
  const auto blade =
      ChromaAlong(bgr, tone, edge, inner - kDeepest * blade_px, inner - kDeep * blade_px);
  if (!band || !ground || !blade) return DarkBand::kUnknown;
  const Chroma way = *blade - *ground;
  if (way.norm() < kToldApart) return DarkBand::kUnknown;
  const double share = (*band - *ground).dot(way) / way.squaredNorm();
  const double unsure = kScatter / way.norm();
  if (share < std::min(kShadow, 0.5 - unsure)) return DarkBand::kShadow;
  const double least_metal = width > kBleedPx ? std::max(kMetal, 0.5 + unsure) : 1 + unsure;
  return share > least_metal ? DarkBand::kMetal : DarkBand::kUnknown;
}

}  // namespace bladecurve
