// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/borrowed_edge.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "vision/image/cross.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/refused.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/edge_doubt.h"
#include "vision/scissors/mirrored_blade.h"
#include "vision/scissors/mirrored_trace.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The other blade's edge, mirrored.
LocatedEdge Borrowed(const LocatedBlade& other, const MirroredTrace& trace, const Pivot& pivot) {
  LocatedEdge edge = other.edge;
  for (LocatedEdgePoint& p : edge.points) p = trace.line.Reflected(p);
  edge.common_sigma_px = std::hypot(edge.common_sigma_px, trace.sigma_px, pivot.SigmaPx());
  edge.ambiguity = kAssumedAmbiguity;
  edge.rival_px = edge.rival_sigma_px = 0;
  edge.rival_path_px.clear();
  return edge;
}

// Whether the inner edge may be the line of a bevel that mirrors the ground without a trace, where
// one of two clear edges must be wrong: of blades brighter than the ground the outer one is no
// shadow's border.
bool MayBeLineOfBevel(const LocatedBlade& inner, const LocatedBlade& outer, const Pivot& pivot) {
  constexpr double kBrighter = -0.1;  // contrast
  return AreUnlike(pivot.asymmetry) && IsClear(inner.edge) && IsClear(outer.edge) &&
         std::max(TypicalContrast(inner.edge), TypicalContrast(outer.edge)) < kBrighter;
}

// Of points turned from the other edge's mirror image, those that agree with most others.
std::vector<MirrorTurn> Agreeing(const std::vector<MirrorTurn>& turns, double within_mm) {
  const auto agree = [&](const MirrorTurn& about) {
    return [rad = about.rad, within_mm](const MirrorTurn& turn) {
      return std::abs(turn.rad - rad) * turn.radius_mm < within_mm;
    };
  };
  std::vector<std::ptrdiff_t> counts;
  for (const MirrorTurn& about : turns)
    counts.push_back(std::count_if(turns.begin(), turns.end(), agree(about)));
  const auto most = std::max_element(counts.begin(), counts.end()) - counts.begin();
  std::vector<MirrorTurn> agreeing;
  std::copy_if(turns.begin(),
               turns.end(),
               std::back_inserter(agreeing),
               agree(turns[static_cast<std::size_t>(most)]));
  return agreeing;
}

// How far aside of a mirror image an edge lies: aside_mm + rad * radius_mm.
struct Displacement {
  double aside_mm = 0, rad = 0;

  explicit Displacement(const std::vector<MirrorTurn>& turns) {
    Eigen::MatrixX2d basis(turns.size(), 2);
    Eigen::VectorXd aside(turns.size());
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      basis.row(row) << 1, turns[i].radius_mm;
      aside[row] = turns[i].rad * turns[i].radius_mm;
    }
    const Vector2d fitted = basis.colPivHouseholderQr().solve(aside);
    aside_mm = fitted[0];
    rad = fitted[1];
  }
};

// The line about which the longest part of an edge is the other's mirror image, if so much of it is
// and of the rest enough clearly lies within the blade: outside of its edge nothing is its line.
std::optional<MirrorLine> LineOfMost(const MirrorLine& line,
                                     const LocatedBlade& blade,
                                     const LocatedBlade& other) {
  constexpr double kUnlike = 0.005;            // of the length
  constexpr double kMost = 0.4, kRest = 0.15;  // of the points
  const std::vector<MirrorTurn> turns = TurnsFromMirrored(line, blade, other);
  if (turns.empty()) return std::nullopt;
  const double length_mm = turns.back().radius_mm;
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(turns.size());
  };
  const std::vector<MirrorTurn> agreeing = Agreeing(turns, kGroundAlike * length_mm);
  if (share(agreeing.size()) < kMost) return std::nullopt;
  const Displacement by(agreeing);
  if (AreUnlike(by.aside_mm / length_mm)) return std::nullopt;
  const Vector2d end = line.map.PlaneFromImage(blade.used.back().trend_px) - line.pivot;
  const double inwards = std::copysign(1.0, Cross(line.direction, end));
  const auto astray = std::count_if(turns.begin(), turns.end(), [&](const MirrorTurn& turn) {
    const double aside_mm = (turn.rad - by.rad) * turn.radius_mm - by.aside_mm;
    return inwards * aside_mm > kUnlike * length_mm;
  });
  if (share(static_cast<std::size_t>(astray)) < kRest) return std::nullopt;
  return MirrorLine{line.map,
                    line.pivot + 0.5 * by.aside_mm * line.Across(),
                    Eigen::Rotation2Dd(0.5 * by.rad) * line.direction};
}

}  // namespace

bool BorrowDoubtfulOne(const BladeView& view, const Pivot& pivot, Blades* blades) {
  constexpr double kSure = 0.2;  // ambiguity
  if (pivot.screw && IsFaint(*pivot.screw)) return false;
  const auto [doubtful, other] = OneOf(blades, IsDoubtful(blades->upper.edge));
  if (!IsDoubtful(doubtful.edge) || !IsClear(other.edge) || other.edge.ambiguity > kSure)
    return false;
  const auto line = LineOfMost(LineBetween(view, pivot, *blades), doubtful, other);
  if (!line) return false;
  const double sigma_px = ShareInPx(kGroundAlike, pivot, *blades);
  const LocatedEdge edge = Borrowed(other, {*line, sigma_px}, pivot);
  const auto found = UnlessRefused([&] {
    return BladeWithEdge({view, pivot, other, *line}, edge);
  });
  if (!found) return false;
  Replace(*found, "the other one mirrored, on which most of it lies", &doubtful);
  return true;
}

void BorrowInnerOne(const BladeView& view,
                    const MirrorLine& line,
                    const Pivot& pivot,
                    Blades* blades) {
  constexpr double kShare = 0.5;  // of the difference, standard
  if (pivot.screw && IsFaint(*pivot.screw)) return;
  if (!DifferBeyondPivot(pivot, *blades)) return;
  const auto [inner, other] = InnerOne(pivot, blades);
  if (IsDoubtful(other.edge)) return;
  const MirroredBladeSearch search{view, pivot, other, line};
  auto trace = FindMirroredTrace(view, inner, other, line, WayPx(search));
  if (!trace && KnowsMirror(view, pivot) && MayBeLineOfBevel(inner, other, pivot))
    trace.emplace(MirroredTrace{line, kShare * WayPx(search)});
  if (!trace) return;
  const LocatedEdge edge = Borrowed(other, *trace, pivot);
  const auto found = UnlessRefused([&] { return BladeWithEdge(search, edge); });
  if (found) Replace(*found, "the other one mirrored, along a faint step in the light", &inner);
}

}  // namespace bladecurve
