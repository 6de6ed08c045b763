// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/mirrored_blade.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vision/image/robust_statistics.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/ground_colour.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Whether an edge lies on the side of its blade that faces the gap, no deeper than where a shadow
// widened what scene finding took for the blade.
bool FacesGap(const Scene& scene, const LocatedBlade& blade) {
  constexpr double kWidest = 0.5;      // such a shadow, of that width
  constexpr std::size_t kEnough = 50;  // places along the edge
  const SceneBlade& seen = BladeOf(scene, blade.on_left);
  std::vector<double> inwards_px;
  for (std::size_t i = 0; i < blade.used.size(); i += 1 + blade.used.size() / kEnough) {
    const LocatedEdgePoint& p = blade.used[i];
    const auto off = [&](const Vector2d& q) { return (q - p.trend_px).squaredNorm(); };
    const auto nearest = std::min_element(
        seen.inner_px.begin(), seen.inner_px.end(), [&](const Vector2d& a, const Vector2d& b) {
          return off(a) < off(b);
        });
    inwards_px.push_back((*nearest - p.trend_px).dot(p.normal));
  }
  return Median(std::move(inwards_px)) < kWidest * seen.width_px;
}

EdgeGuess GuessWithin(const MirroredBladeSearch& search, double search_px) {
  EdgeGuess guess;
  for (const LocatedEdgePoint& p : search.other.edge.points) {
    if (p.inlier) guess.path_px.push_back(search.line.Reflected(p.trend_px));
  }
  guess.blade_on_left = !search.other.on_left;
  guess.search_px = search_px;
  return guess;
}

constexpr double kOfWay = 0.35;

// At least so far aside, and further where the way is long.
double Widened(const MirroredBladeSearch& search, double search_px) {
  return std::max(search_px, kOfWay * WayPx(search));
}

// The other side of the blade, or a line within it, may lie there too.
template <typename Look>
std::optional<RelocatedBlade> IfItFacesGap(const MirroredBladeSearch& search, const Look& look) {
  auto found = UnlessRefused([&] { return BladeWithEdge(search, look()); });
  return found && FacesGap(search.view.scene(), found->blade) ? std::move(found) : std::nullopt;
}

}  // namespace

double WayPx(const MirroredBladeSearch& search) {
  return std::abs(search.pivot.asymmetry) *
         (search.other.end.point_px - search.pivot.point_px).norm();
}

double LeftOfDifference(const MirroredBladeSearch& search, const RelocatedBlade& found) {
  return std::abs(found.asymmetry) / std::abs(search.pivot.asymmetry);
}

RelocatedBlade BladeWithEdge(const MirroredBladeSearch& search, LocatedEdge edge) {
  RelocatedBlade found;
  found.blade.on_left = !search.other.on_left;
  found.blade.edge = std::move(edge);
  TrimToFree(search.view, &found.blade);
  found.asymmetry = AsymmetryOf(search.view, search.pivot, found.blade, search.other);
  return found;
}

std::optional<RelocatedBlade> LookNearMirrored(const MirroredBladeSearch& search,
                                               double search_px) {
  auto found = IfItFacesGap(
      search, [&] { return search.view.InGreyOrColours(GuessWithin(search, search_px)); });
  const bool shadows =
      found &&
      LiesInGround(search.view, found->blade.edge, search.other.edge, found->blade.on_left);
  return shadows ? std::nullopt : std::move(found);
}

std::optional<RelocatedBlade> LookInShadow(const MirroredBladeSearch& search,
                                           double search_px,
                                           Shadow shadow) {
  std::optional<LocatedEdge> edge =
      search.view.InShadow(GuessWithin(search, Widened(search, search_px)), shadow);
  if (!edge) return std::nullopt;
  return IfItFacesGap(search, [&] { return *std::move(edge); });
}

std::optional<RelocatedBlade> LookInColours(const MirroredBladeSearch& search, double search_px) {
  std::optional<LocatedEdge> edge =
      search.view.InColoursAlone(GuessWithin(search, search_px), /*shade=*/0);
  if (!edge) return std::nullopt;
  return IfItFacesGap(search, [&] { return *std::move(edge); });
}

std::optional<RelocatedBlade> LookWhereMirrored(const MirroredBladeSearch& search) {
  constexpr double kNearest = 5, kShortOf = 0.6;   // px; of the way to where it was
  constexpr double kMuchLess = 0.5, kSame = 0.85;  // of the difference before, where there is one
  const bool suspect = AreSuspect(search.pivot.asymmetry);
  const auto if_alike = [&](std::optional<RelocatedBlade> found) {
    const bool alike = found && AreAlike(found->asymmetry) &&
                       !(suspect && LeftOfDifference(search, *found) >= kMuchLess);
    return alike ? std::move(found) : std::nullopt;
  };
  std::optional<RelocatedBlade> found = LookNearMirrored(search, Widened(search, kNearest));
  if (!suspect || !found || LeftOfDifference(search, *found) <= kSame)
    return if_alike(std::move(found));
  // That is the line that is doubted.
  found = if_alike(LookNearMirrored(search, kShortOf * WayPx(search)));
  if (!found) return std::nullopt;
  std::optional<RelocatedBlade> nearer = if_alike(LookNearMirrored(search, kOfWay * WayPx(search)));
  const bool clearer = nearer && nearer->blade.edge.ambiguity < found->blade.edge.ambiguity;
  return clearer ? std::move(nearer) : std::move(found);
}

void Replace(const RelocatedBlade& found, const char* where, LocatedBlade* blade) {
  *blade = found.blade;
  blade->moved = where;
}

void MarkAsAssumed(const BladeView& view, const Pivot& pivot, LocatedBlade* blade) {
  if (!KnowsMirror(view, pivot))
    blade->edge.ambiguity = std::max(blade->edge.ambiguity, kAssumedAmbiguity);
}

void ReplaceAssumed(const MirroredBladeSearch& search,
                    const RelocatedBlade& found,
                    const char* where,
                    LocatedBlade* blade) {
  constexpr double kShare = 0.6;  // of the way, standard
  if (KnowsMirror(search.view, search.pivot)) return Replace(found, where, blade);
  const double way_px = MedianDistance(found.blade.edge, blade->edge);
  Replace(found, where, blade);
  MarkAsAssumed(search.view, search.pivot, blade);
  AddSigma(&blade->edge, kShare * way_px);
}

}  // namespace bladecurve
