// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_shadow.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "vision/image/chroma.h"
#include "vision/image/pixel_light.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kBlur = 1.5;  // px; nearer to a step both sides mix

// A strip along an edge, px from it, positive out of the blade.
struct Strip {
  double from, to;
};

// The strips that tell what a dark band is.
struct Strips {
  double inner, outer;  // the band's two steps

  explicit Strips(double rival_px)
      : inner(std::min(rival_px, 0.0)), outer(std::max(rival_px, 0.0)) {}

  [[nodiscard]] double Width() const { return outer - inner; }
  [[nodiscard]] Strip Band() const { return {inner + kBlur, outer - kBlur}; }
  [[nodiscard]] Strip Ground() const { return {outer + kBlur + 1, outer + kBlur + 1 + Width()}; }
  [[nodiscard]] Strip FartherGround() const {
    return {Ground().from + Width(), Ground().to + Width()};
  }
};

// Typical colour of a strip.
std::optional<Chroma> ChromaAlong(const PicturePart& bgr,
                                  const ToneCurve& tone,
                                  const LocatedEdge& edge,
                                  const Strip& strip) {
  constexpr std::size_t kStride = 2, kFewest = 20;
  std::vector<double> blue, red;
  for (std::size_t i = 0; i < edge.points.size(); i += kStride) {
    const LocatedEdgePoint& point = edge.points[i];
    for (double across = strip.from; across <= strip.to; ++across) {
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

// metal: what lies within the band and is metal for certain.
DarkBand JudgeByColour(const PicturePart& bgr,
                       const ToneCurve& tone,
                       const LocatedEdge& edge,
                       const Strip& metal) {
  constexpr double kToldApart = 0.15;             // chromas nearer than that are not
  constexpr double kShadow = 0.45, kMetal = 0.6;  // of the way from background to blade
  constexpr double kBleedPx = 5;  // colours are stored at half the resolution: bright metal lends a
                                  // narrow dark band its own, but no more than that
  constexpr double kScatter = 0.05;  // of chromas: skylight, colours that bleed
  const Strips strips(edge.rival_px);
  const auto band = ChromaAlong(bgr, tone, edge, strips.Band());
  const auto ground = ChromaAlong(bgr, tone, edge, strips.Ground());
  const auto blade = ChromaAlong(bgr, tone, edge, metal);
  if (!band || !ground || !blade) return DarkBand::kUnknown;
  const Chroma way = *blade - *ground;
  if (way.norm() < kToldApart) return DarkBand::kUnknown;
  const double share = (*band - *ground).dot(way) / way.squaredNorm();
  const double unsure = kScatter / way.norm();
  if (share < std::min(kShadow, 0.5 - unsure)) return DarkBand::kShadow;
  const double least_metal =
      strips.Width() > kBleedPx ? std::max(kMetal, 0.5 + unsure) : 1 + unsure;
  return share > least_metal ? DarkBand::kMetal : DarkBand::kUnknown;
}

// The first of the points from which on the other blade is further off than `reach_px`.
std::size_t FirstClearOf(const std::vector<Vector2d>& other_px,
                         const LocatedEdge& edge,
                         double reach_px) {
  constexpr std::size_t kEnough = 50;  // places along the other edge
  const std::size_t stride = 1 + other_px.size() / kEnough;
  const auto is_near = [&](const LocatedEdgePoint& point) {
    for (std::size_t i = 0; i < other_px.size(); i += stride) {
      if ((other_px[i] - point.trend_px).norm() < reach_px) return true;
    }
    return false;
  };
  const auto last_near = std::find_if(edge.points.rbegin(), edge.points.rend(), is_near);
  return static_cast<std::size_t>(edge.points.rend() - last_near);
}

// Of the points along an edge that tell a pattern.
std::size_t StrideOf(const LocatedEdge& edge) {
  constexpr std::size_t kEnough = 400;
  return 1 + edge.points.size() / kEnough;
}

// How light changes along a strip: its logarithm at the points from `first` on, less a parabola, as
// light falls off over ground and metal alike.
std::optional<VectorXd> PatternAlong(const PicturePart& bgr,
                                     const ToneCurve& tone,
                                     const LocatedEdge& edge,
                                     std::size_t first,
                                     const Strip& strip) {
  constexpr double kBlack = 0.001;  // of white
  constexpr std::size_t kFewest = 40;
  constexpr double kAcross = 8;  // places across a wide strip
  if (edge.points.size() < first + kFewest) return std::nullopt;
  const std::size_t stride = StrideOf(edge);
  const double step = std::max(1.0, (strip.to - strip.from) / kAcross);
  VectorXd pattern(static_cast<Eigen::Index>((edge.points.size() - first + stride - 1) / stride));
  Eigen::MatrixX3d parabola(pattern.size(), 3);
  for (Eigen::Index i = 0; i < pattern.size(); ++i) {
    const LocatedEdgePoint& point = edge.points[first + stride * static_cast<std::size_t>(i)];
    double sum = 0, count = 0;
    for (double across = strip.from; across <= strip.to; across += step) {
      const auto light = LightAt(bgr, tone, point.trend_px + across * point.normal);
      if (!light) return std::nullopt;
      sum += light->mean();
      ++count;
    }
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(pattern.size() - 1) - 1;
    pattern[i] = std::log(std::max(kBlack, sum / std::max(count, 1.0)));
    parabola.row(i) << 1, t, t * t;
  }
  const Eigen::Vector3d usual = parabola.colPivHouseholderQr().solve(pattern);
  return pattern - parabola * usual;
}

// How one pattern goes with another, moved along the edge to where it does best.
struct Likeness {
  double correlation = -1;
  double slope = 0;  // of the second on the first
};

Likeness Compare(const VectorXd& a, const VectorXd& b, Eigen::Index most_moved) {
  Likeness best;
  for (Eigen::Index moved = -most_moved; moved <= most_moved; ++moved) {
    const Eigen::Index size = a.size() - std::abs(moved);
    const auto from_a = a.segment(std::max<Eigen::Index>(0, -moved), size);
    const auto from_b = b.segment(std::max<Eigen::Index>(0, moved), size);
    const double squares = from_a.squaredNorm(), product = from_a.dot(from_b);
    const double correlation = product / std::sqrt(squares * from_b.squaredNorm());
    if (correlation > best.correlation) best = {correlation, product / squares};
  }
  return best;
}

}  // namespace

DarkBand JudgeByPattern(const PicturePart& picture,
                        const ToneCurve& tone,
                        const LocatedEdge& edge,
                        const std::vector<Vector2d>& other_px) {
  constexpr double kLeastContrast = 0.02;  // of the ground, standard, as a share of its light
  constexpr double kGoesOn = 0.8, kFollows = 0.7;  // correlations
  // Of the slope of ground on farther ground. Stray light lowers it in shadows, to 0.23 in the sun;
  // mirrors reach 0.7.
  constexpr double kAsMuch = 0.8, kHardly = 0.12;
  // Light that falls off towards a blade changes more the nearer it is, a pattern does not.
  constexpr double kMostSlope = 1.5;
  const Strips strips(edge.rival_px);
  const std::size_t first = FirstClearOf(other_px, edge, strips.FartherGround().to + kBlur);
  const auto band = PatternAlong(picture, tone, edge, first, strips.Band());
  const auto ground = PatternAlong(picture, tone, edge, first, strips.Ground());
  const auto farther = PatternAlong(picture, tone, edge, first, strips.FartherGround());
  if (!band || !ground || !farther) return DarkBand::kUnknown;
  const double spacing_px = (edge.points.back().trend_px - edge.points.front().trend_px).norm() /
                            static_cast<double>(edge.points.size()) *
                            static_cast<double>(StrideOf(edge));
  const auto most_moved =
      std::min(static_cast<Eigen::Index>(2 * strips.Width() / spacing_px), ground->size() / 2);
  const Likeness goes_on = Compare(*farther, *ground, most_moved);
  const Likeness follows = Compare(*ground, *band, most_moved);
  const double contrast = ground->norm() / std::sqrt(static_cast<double>(ground->size()));
  if (contrast < kLeastContrast || goes_on.correlation < kGoesOn) return DarkBand::kUnknown;
  if (std::max(goes_on.slope, follows.slope) > kMostSlope) return DarkBand::kUnknown;
  if (follows.correlation > kFollows && follows.slope > kAsMuch * goes_on.slope)
    return DarkBand::kShadow;
  return follows.slope < kHardly * goes_on.slope ? DarkBand::kMetal : DarkBand::kUnknown;
}

DarkBand JudgeDarkBand(const PicturePart& bgr,
                       const ToneCurve& tone,
                       const LocatedEdge& edge,
                       double blade_px,
                       const std::vector<Vector2d>& other_px) {
  constexpr double kDeepest = 0.45, kDeep = 0.25;  // of the blade's width, from the inner step
  const double inner = std::min(edge.rival_px, 0.0);
  const DarkBand by_colour =
      JudgeByColour(bgr, tone, edge, {inner - kDeepest * blade_px, inner - kDeep * blade_px});
  return by_colour == DarkBand::kUnknown ? JudgeByPattern(bgr, tone, edge, other_px) : by_colour;
}

bool IsGroundBesideBevel(const PicturePart& bgr,
                         const ToneCurve& tone,
                         const LocatedEdge& edge,
                         double width_px) {
  constexpr double kNarrowestPx = 1;  // of the bevel, but for the blur at both its lines
  const Strip bevel{edge.rival_px + kBlur, -width_px - kBlur};
  if (bevel.to - bevel.from < kNarrowestPx) return false;
  LocatedEdge beside = edge;
  beside.rival_px = -width_px;
  return JudgeByColour(bgr, tone, beside, bevel) == DarkBand::kShadow;
}

}  // namespace bladecurve
