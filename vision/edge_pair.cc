// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_pair.h"

#include <algorithm>
#include <vector>

#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The edge as scene finding traced it, for want of a better one: good to a pixel of the small
// picture, and marked as doubtful.
LocatedEdge AsTraced(const Scene& scene, const SceneBlade& blade, bool left) {
  LocatedEdge edge;
  const std::vector<Vector2d>& path = blade.inner_px;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector2d along =
        (path[std::min(i + 3, path.size() - 1)] - path[i < 3 ? 0 : i - 3]).normalized();
    LocatedEdgePoint point;
    point.point_px = path[i];
    point.trend_px = path[i];
    point.normal = (left ? -1.0 : 1.0) * Vector2d(along.y(), -along.x());
    point.sigma_px = 2 * scene.path_sigma_px;
    edge.points.push_back(point);
  }
  edge.correlation_px = 10 * scene.path_sigma_px;
  edge.common_sigma_px = 2 * scene.path_sigma_px;
  edge.ambiguity = 1;
  return edge;
}

// Where the scene saw a blade's edge, and how far from there it may lie.
EdgeGuess GuessFor(const Scene& scene, bool left) {
  constexpr double kNearest = 5;     // px
  constexpr double kFarthest = 0.3;  // of the blade's width: shadow or bevel led the trace astray
  const SceneBlade& blade = left ? scene.left : scene.right;
  EdgeGuess guess;
  guess.path_px = blade.inner_px;
  guess.blade_on_left = left;
  guess.search_px = std::max(kNearest, 1.5 * scene.path_sigma_px + kFarthest * blade.width_px);
  return guess;
}

// Cut off at white, the step of a glaring blade looks sharper than the other blade's, and lies too
// far out.
bool Glares(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kOverexposed = 0.2, kPlain = 0.05;  // share of an edge
  constexpr double kSharper = 0.85;  // ratio of the blurs; focus and motion differ by less
  constexpr double kOneStep = 0.5;  // ambiguity; the blur of bevel and shadow together is no lens's
  return edge.overexposed > kOverexposed && other.overexposed < kPlain &&
         other.ambiguity < kOneStep && edge.blur_px < kSharper * other.blur_px;
}

// A glaring blade's edge once more, with the blur that the other blade shows.
void TieBlur(const Photo& photo,
             const ToneCurve& tone,
             const EdgeGuess& guess,
             const LocatedEdge& other,
             LocatedEdge* edge) {
  if (!Glares(*edge, other)) return;
  EdgeOptions options;
  options.blur_px = other.blur_px;
  *edge = LocateEdge(photo.grey(), tone, guess, options);
}

LocatedEdge LocateOrTrace(const Photo& photo,
                          const ToneCurve& tone,
                          const Scene& scene,
                          const EdgeGuess& guess) {
  try {
    return LocateEdge(photo.grey(), tone, guess);
  } catch (const Refused&) {
    return AsTraced(scene, guess.blade_on_left ? scene.left : scene.right, guess.blade_on_left);
  }
}

}  // namespace

BladeEdges LocateBlades(const Photo& photo,
                      const ToneCurve& tone,
                      const Scene& scene,
                      bool upper_on_left) {
  const EdgeGuess upper = GuessFor(scene, upper_on_left), lower = GuessFor(scene, !upper_on_left);
  BladeEdges edges{LocateEdge(photo.grey(), tone, upper), LocateOrTrace(photo, tone, scene, lower)};
  TieBlur(photo, tone, upper, edges.lower, &edges.upper);
  TieBlur(photo, tone, lower, edges.upper, &edges.lower);
  return edges;
}

}  // namespace bladecurve
