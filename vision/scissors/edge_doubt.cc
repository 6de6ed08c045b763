// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_doubt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "vision/edge/edge_curve.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scissors/consistency.h"

namespace bladecurve {
namespace {

constexpr double kVaguePx = 1;  // common uncertainty

// Whether the edges pass by a pivot that is seen or told so differently that one of them is in
// doubt. Of what is less unlike than blades may be, about a screw, the pivot's uncertainty must
// leave some unexplained where markers tell the tilt of the view.
bool PassUnlike(const Pivot& pivot, const ScaleResult& scale, const Blades& blades) {
  constexpr double kSigmas = 2;
  if (pivot.source == "geometry") return false;
  if (pivot.source != "screw" || AreUnlike(pivot.asymmetry)) return AreUnlike(pivot.asymmetry);
  return AreSuspect(pivot.asymmetry) && (!scale.sheet || DifferBeyondPivot(pivot, blades, kSigmas));
}

}  // namespace

bool IsClear(const LocatedEdge& edge) {
  constexpr double kClear = 0.5;  // ambiguity
  return edge.ambiguity <= kClear && edge.common_sigma_px <= kVaguePx;
}

bool IsDoubtful(const LocatedEdge& edge) {
  constexpr double kDoubt = 0.75;  // ambiguity
  return edge.ambiguity > kDoubt || edge.common_sigma_px > kVaguePx;
}

bool HasBevelWithin(const LocatedEdge& edge) {
  constexpr double kShows = 0.2;  // ambiguity
  return edge.rival_px < 0 && edge.ambiguity > kShows;
}

bool HardlyShowsBeside(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kHardly = 0.05;
  return std::abs(TypicalContrast(edge)) <= kHardly * std::abs(TypicalContrast(other));
}

void AddSigma(LocatedEdge* edge, double off_px) {
  edge->common_sigma_px = std::hypot(edge->common_sigma_px, off_px);
  edge->alone_sigma_px = std::hypot(edge->alone_sigma_px, off_px);
}

void Doubt(LocatedEdge* edge, double off_px) {
  constexpr double kDoubt = 0.75;  // ambiguity
  edge->ambiguity = std::max(edge->ambiguity, kDoubt);
  AddSigma(edge, off_px);
}

void DoubtForRival(LocatedEdge* edge, double off_px) {
  Doubt(edge, off_px);
  edge->rival_sigma_px = std::hypot(edge->rival_sigma_px, off_px);
}

double SigmaWithoutRival(const LocatedEdge& edge) {
  return std::sqrt(
      std::max(0.0, std::pow(edge.common_sigma_px, 2) - std::pow(edge.rival_sigma_px, 2)));
}

void DropRival(LocatedEdge* edge) {
  edge->common_sigma_px = SigmaWithoutRival(*edge);
  edge->rival_sigma_px = 0;
  edge->ambiguity = std::min(edge->ambiguity, kAsGood);
}

void KeepRival(const LocatedEdge& wider, LocatedEdge* narrower) {
  constexpr double kSamePx = 1;
  if (wider.ambiguity <= narrower->ambiguity || MedianDistance(*narrower, wider) > kSamePx) return;
  narrower->ambiguity = wider.ambiguity;
  narrower->rival_px = wider.rival_px;
  narrower->rival_path_px = wider.rival_path_px;
  narrower->rival_sigma_px = wider.rival_sigma_px;
  narrower->common_sigma_px = std::max(narrower->common_sigma_px, wider.common_sigma_px);
}

void SetRival(LocatedEdge* edge, double rival_px) {
  edge->rival_px = rival_px;
  edge->rival_path_px.clear();
  for (const LocatedEdgePoint& p : edge->points)
    edge->rival_path_px.push_back(p.trend_px + rival_px * p.normal);
}

double ByRivalPx(const LocatedBlade& blade) {
  return (blade.on_left ? 1 : -1) * blade.edge.rival_px;
}

void DoubtUnlikeEdges(const Pivot& pivot, const ScaleResult& scale, Blades* blades) {
  constexpr double kOff = 0.1;    // sigma, of how unlike they pass; over annotated photographs
  constexpr double kShare = 0.6;  // sigma, of the way to the other one
  constexpr double kLeft = 0.5;   // of how unlike they pass
  if (!PassUnlike(pivot, scale, *blades)) return;
  const double length_px = BladeLengthPx(pivot, *blades);
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    LocatedEdge& edge = blade->edge;
    AddSigma(&edge, kOff * pivot.asymmetry * length_px);
    const double left = pivot.asymmetry + ByRivalPx(*blade) / length_px;
    if (!AreAlike(left) || std::abs(left) > kLeft * std::abs(pivot.asymmetry)) continue;
    Doubt(&edge, kShare * edge.rival_px);
  }
}

Kink KinkOf(const LocatedBlade& blade) {
  constexpr double kMost = 0.95;  // of the places
  return {OffPlainCurve(blade.used, kMost),
          (blade.used.back().trend_px - blade.used.front().trend_px).norm()};
}

bool IsKinked(const Kink& kink, const LocatedEdge& edge) {
  constexpr double kKinked = 0.003;  // of the edge's length
  constexpr double kLeastPx = 0.5;
  return kink.off_px > std::max({kKinked * kink.length_px, kLeastPx, TotalSigma(edge)});
}

void DoubtKinkedEdges(Blades* blades) {
  constexpr double kTwoLines = 0.02;  // of the edge's length
  constexpr double kTimes = 2;
  const std::array<LocatedBlade*, 2> both{&blades->upper, &blades->lower};
  const std::vector<Kink> kinks =
      ParallelMap(2, [&](int i) { return KinkOf(*both[static_cast<std::size_t>(i)]); });
  for (std::size_t i = 0; i < both.size(); ++i) {
    LocatedBlade* const blade = both[i];
    const double kink_px = kinks[i].off_px;
    if (blade == &blades->upper && kink_px > kTwoLines * kinks[i].length_px) {
      throw Refused(Reason::kLowContrast,
                    "edges: the upper cutting edge leaves a blade's smooth course by " +
                        std::to_string(std::lround(kink_px)) +
                        " px, as where the line of a bevel or the border of a shadow is followed "
                        "part of the way; use another background or light");
    }
    if (IsKinked(kinks[i], blade->edge)) Doubt(&blade->edge, kTimes * kink_px);
  }
}

void DoubtSofterEdge(Blades* blades) {
  // Standard uncertainty per px of blur, over annotated photographs; rendered scenes need a third.
  constexpr double kPerSofter = 1.2;
  const double softer_px = blades->upper.edge.blur_px - blades->lower.edge.blur_px;
  if (!std::isfinite(softer_px)) return;
  AddSigma(&(softer_px > 0 ? blades->upper : blades->lower).edge, kPerSofter * softer_px);
}

void DoubtUnlikePrint(const ScaleResult& scale, Blades* blades) {
  constexpr double kSharper = 0.7;  // of the blurs; of good edges in the sun 99 % exceed 0.78
  constexpr double kOffPx = 1;      // at least
  // Standard uncertainty per px of blur, as edges rendered in the sun are off.
  constexpr double kPerSharper = 1.5, kPerSofter = 0.7;
  const std::optional<double> print_px = PrintBlurPx(scale.markers);
  if (!print_px) return;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    LocatedEdge& edge = blade->edge;
    if (edge.blur_px < kSharper * *print_px) Doubt(&edge, kOffPx);
    if (!std::isfinite(edge.unbound_blur_px)) continue;
    const double softer_px = edge.unbound_blur_px - *print_px;
    const double off_px = std::max(kPerSofter * softer_px, -kPerSharper * softer_px);
    AddSigma(&edge, off_px);
  }
}

void DoubtLaterLook(const Scene& scene, const Pivot& pivot, Blades* blades) {
  constexpr double kOfLength = 0.01;  // over annotated photographs
  constexpr double kOfBent = 0.03;    // over rendered ones: no edge confirms the other
  if (!scene.second_look) return;
  for (LocatedBlade* blade : {&blades->upper, &blades->lower})
    AddSigma(&blade->edge, (pivot.bent ? kOfBent : kOfLength) * BladeLengthPx(pivot, *blades));
}

void DoubtUnlikeEnds(const Pivot& pivot, const ScaleResult& scale, Blades* blades) {
  constexpr double kOfDifference = 0.3;
  if (!PassUnlike(pivot, scale, *blades)) return;
  const double turned_px =
      kOfDifference * std::abs(pivot.asymmetry) * BladeLengthPx(pivot, *blades) / std::sqrt(2.0);
  for (LocatedBlade* blade : {&blades->upper, &blades->lower})
    blade->end.across_sigma_px = std::hypot(blade->end.across_sigma_px, turned_px);
}

}  // namespace bladecurve
