// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_candidate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "vision/image/cross.h"
#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"
#include "vision/scene/beyond_tips.h"
#include "vision/scene/closed_shape.h"
#include "vision/scene/covered_handles.h"
#include "vision/scene/limbs.h"
#include "vision/scene/silhouette.h"
#include "vision/scene/touching_handles.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kSharpReach = 1.5;  // px of the small picture: all of a sharp border's transition

// Median difference between `reach` px on both sides of a path that is moved `aside` px to one
// side, in the units of the image.
double TransitionAcross(const ScaledImage& image,
                        const std::vector<Vector2d>& path,
                        double reach,
                        double aside = 0) {
  std::vector<double> steps;
  for (std::size_t i = 3; i + 3 < path.size(); i += 2) {
    const Vector2d along = (path[i + 3] - path[i - 3]).normalized();
    const Vector2d across(along.y(), -along.x());
    const Vector2d here = path[i] + (aside + reach) * across;
    const Vector2d there = path[i] + (aside - reach) * across;
    steps.push_back((image.ColourAt(here) - image.ColourAt(there)).norm());
  }
  return steps.empty() ? 0 : Median(steps);
}

// Shadows that pass for blades reach 0.25, blades on the same photographs have 0.45 and more.
constexpr double kSoft = 0.25, kSharp = 0.4;

// How much of the transition across a contour is that of one sharp line. Beside a soft shadow, or
// on texture, a blade's contour may run a little off its edge; a sharp line there counts for less,
// as it may be another one.
double SharpnessOf(const ScaledImage& image, const std::vector<Vector2d>& path, double near) {
  constexpr double kSoftReach = 5;  // px of the small picture: most of a soft shadow's transition
  constexpr double kMostAside = 4;
  constexpr double kSharpBeside = 0.5,
                   kCounts = 0.36;  // soft borders reach 0.36 beside the contour
  const double far = std::max(1e-6, TransitionAcross(image, path, kSoftReach));
  if (near > kCounts * far) return near / far;
  for (double aside = -kMostAside; aside <= kMostAside; ++aside) {
    if (TransitionAcross(image, path, kSharpReach, aside) > kSharpBeside * far) return kCounts;
  }
  return near / far;
}

// Fills in strength and sharpness. Of the two inner edges the weaker and the softer counts: a
// shadow that passes for a blade has a soft border.
void JudgeEdges(const BladePair& pair, Candidate* candidate) {
  const ScaledImage& image = *candidate->at;
  candidate->strength = std::numeric_limits<double>::infinity();
  candidate->sharpness = std::numeric_limits<double>::infinity();
  for (const BladeContour* blade : {&pair.first, &pair.second}) {
    const double near = TransitionAcross(image, blade->inner, kSharpReach);
    candidate->strength = std::min(candidate->strength, near);
    candidate->sharpness = std::min(candidate->sharpness, SharpnessOf(image, blade->inner, near));
  }
}

void DoubtSoftEdges(Candidate* candidate) {
  ApplyGrade(Grade(-candidate->sharpness, -kSharp, -kSoft),
             "an edge is soft like a shadow's",
             &candidate->pair);
}

// An edge along what is hidden was drawn by that, as the gaps between the markers of a card are.
void DoubtEdgesOfHidden(const cv::Mat& hidden, Candidate* candidate) {
  constexpr double kMost = 0.5;  // of the edge
  if (hidden.empty()) return;
  for (const BladeContour* blade : {&candidate->pair.first, &candidate->pair.second}) {
    const auto along = std::count_if(blade->inner.begin(),
                                     blade->inner.end(),
                                     [&](const Vector2d& p) { return IsSetNear(hidden, p); });
    if (static_cast<double>(along) <= kMost * static_cast<double>(blade->inner.size())) continue;
    candidate->pair.quality = candidate->pair.worst_grade = 0;
    candidate->pair.doubt = "an edge is the border of a marker's paper";
  }
}

// Blades beyond whose tips other things go on are stubs of shanks, of whose outline some was lost.
void DoubtStubs(const cv::Mat& mask, const Silhouette& silhouette, BladePair* pair) {
  if (!GoOnBeyondTips(mask, silhouette, *pair)) return;
  pair->quality = pair->worst_grade = 0;
  pair->doubt = "the blades go on beyond their tips";
}

// Short blades, narrow and as wide near their tips as near the crotch, are lines that cross, as
// those of a cutting mat's grid do.
void DoubtLines(const cv::Mat& mask, BladePair* pair) {
  constexpr double kShort = 0.1;             // of the picture's longer side
  constexpr double kNarrow = 0.16;           // of the length
  constexpr double kNear = 0.3, kFar = 0.8;  // of the length
  constexpr double kAsWide = 0.85;           // far, of near; one in fifty blades has more
  const BladeContour &first = pair->first, &second = pair->second;
  const auto is_narrow = [&](const BladeContour& b) { return b.width < kNarrow * b.length; };
  if (SizeOf(*pair) > kShort * std::max(mask.cols, mask.rows)) return;
  if (!is_narrow(first) || !is_narrow(second)) return;
  const auto width = [&](double share) {
    return WidthAcross(mask, pair->crotch, first.tip, share) +
           WidthAcross(mask, pair->crotch, second.tip, share);
  };
  if (width(kFar) > kAsWide * width(kNear)) ApplyGrade(0, "lines that cross", pair);
}

template <typename T>
const T& PlaceAlong(const std::vector<T>& path, double share) {
  return path[static_cast<std::size_t>(share * static_cast<double>(path.size() - 1))];
}

// Lightness, 0 to 100, at those of the places that lie in the picture.
std::vector<double> LightnessAt(const cv::Mat& image, const std::vector<Vector2d>& places) {
  std::vector<double> lightness;
  for (const Vector2d& p : places) {
    const cv::Point at = NearestPixel(p);
    if (at.x < 0 || at.y < 0 || at.x >= image.cols || at.y >= image.rows) continue;
    lightness.push_back(image.ptr<float>(at.y)[at.x * image.channels()]);
  }
  return lightness;
}

constexpr std::array kAlong{0.4, 0.5, 0.6, 0.7, 0.8};  // of the blades

std::vector<double> LightnessOfGap(const cv::Mat& image, const BladePair& pair) {
  std::vector<Vector2d> places;
  for (const double along : kAlong) {
    const Vector2d& from = PlaceAlong(pair.first.inner, along);
    const Vector2d& to = PlaceAlong(pair.second.inner, along);
    for (const double across : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8})
      places.emplace_back(from + across * (to - from));
  }
  return LightnessAt(image, places);
}

std::vector<double> LightnessBeside(const cv::Mat& image, const BladeContour& blade) {
  constexpr double kLeastPx = 4;
  const Vector2d across =
      (PlaceAlong(blade.outer, 0.5) - PlaceAlong(blade.inner, 0.5)).normalized();
  std::vector<Vector2d> places;
  for (const double along : kAlong) {
    for (const double way : {0.5, 1.0})
      places.emplace_back(PlaceAlong(blade.outer, along) +
                          std::max(kLeastPx, way * blade.width) * across);
  }
  return LightnessAt(image, places);
}

// Between blades lies the ground, if anything darker for their shadows. What shines there more than
// the ground beside both is a blade, and one of the two its shadow.
void DoubtShiningGap(Candidate* candidate) {
  constexpr double kShare = 0.75;                // of the gap is no brighter
  constexpr double kAsGround = 8, kShines = 14;  // lightness; gaps on marble and wood reach 5
  const cv::Mat& image = candidate->at->pixels;
  BladePair& pair = candidate->pair;
  std::vector<double> gap = LightnessOfGap(image, pair);
  const std::vector<double> first = LightnessBeside(image, pair.first);
  const std::vector<double> second = LightnessBeside(image, pair.second);
  if (gap.empty() || first.empty() || second.empty()) return;
  std::sort(gap.begin(), gap.end());
  const double excess = PlaceAlong(gap, kShare) - std::max(Median(first), Median(second));
  ApplyGrade(Grade(excess, kAsGround, kShines), "the gap shines like a blade", &pair);
}

// Whether a pair may turn about a place: near the line between its crotches, which shadows may put
// further apart, but no nearer.
bool LiesOnJoint(const Vector2d& place, const BladePair& pair) {
  constexpr double kAside = 1, kBeyond = 1;  // of the shanks' width
  const Vector2d from = pair.shank_crotch.value_or(pair.pivot), joint = pair.crotch - from;
  const double length = std::max(1e-9, joint.norm());
  const double along = (place - from).dot(joint) / length;
  const double aside = Cross(joint, place - from) / length;
  const double beyond = std::max(-along, along - length);
  return std::abs(aside) < kAside * pair.shank_width && beyond < kBeyond * pair.shank_width;
}

bool AgreesWithHints(const BladePair& pair, const ScaledImage& at, const StoredHints& hints) {
  if (hints.tips_direction) {
    const Vector2d towards = 0.5 * (pair.first.tip + pair.second.tip) - pair.pivot;
    if (towards.normalized().dot(*hints.tips_direction) < 0.5) return false;
  }
  return !hints.pivot_px || LiesOnJoint(at.SmallFromFull(*hints.pivot_px), pair);
}

// Of the pairs of a silhouette in the mask of `like`, the likeliest first, the first that is worth
// keeping and agrees with the hints. `contradicting`: as of a rung.
std::optional<Candidate> FirstOf(std::vector<BladePair> pairs,
                                 const Silhouette& silhouette,
                                 const Candidate& like,
                                 const cv::Mat& hidden,
                                 const StoredHints& hints,
                                 double* contradicting) {
  constexpr double kWorthKeeping = 0.2;  // what clutter reaches
  for (BladePair& pair : pairs) {
    if (like.outlined && pair.quality >= kWorthKeeping) DoubtStubs(like.mask, silhouette, &pair);
    DoubtLines(like.mask, &pair);
    if (pair.quality < kWorthKeeping) continue;
    if (!AgreesWithHints(pair, *like.at, hints)) {
      *contradicting = std::max(*contradicting, pair.quality);
      continue;
    }
    Candidate candidate = like;
    JudgeEdges(pair, &candidate);
    candidate.pair = std::move(pair);
    if (!like.outlined) DoubtSoftEdges(&candidate);
    DoubtEdgesOfHidden(hidden, &candidate);
    if (!like.patterned) DoubtShiningGap(&candidate);
    return candidate;
  }
  return std::nullopt;
}

constexpr int kMostThings = 4;  // a ruler, a card, a label, and the scissors

// Fills in `agreeing`.
void CountAgreeing(std::vector<Candidate>* candidates) {
  for (Candidate& a : *candidates) {
    a.agreeing = static_cast<int>(
        std::count_if(candidates->begin(), candidates->end(), [&](const Candidate& b) {
          return SameBlades(a, b);
        }));
  }
}

}  // namespace

double SizeOf(const BladePair& pair) { return std::max(pair.first.length, pair.second.length); }

bool SameBlades(const Candidate& a, const Candidate& b) {
  const double near = 0.25 * a.at->full_px_per_px() * SizeOf(a.pair);
  const auto apart = [&](const Vector2d& p, const Vector2d& q) {
    return (a.at->FullFromSmall(p) - b.at->FullFromSmall(q)).norm() > near;
  };
  return !apart(a.pair.pivot, b.pair.pivot) && !apart(a.pair.first.tip, b.pair.first.tip) &&
         !apart(a.pair.second.tip, b.pair.second.tip);
}

Rung SeenIn(const cv::Mat& mask,
            const Candidate& like,
            const cv::Mat& hidden,
            const StoredHints& hints) {
  constexpr double kPlainlyOpen = 0.8;
  Candidate in_mask = like;
  in_mask.mask = mask;
  const auto first_of = [&](const Silhouette& silhouette, double* contradicting) {
    return FirstOf(
        FindBladePairs(silhouette, hidden), silhouette, in_mask, hidden, hints, contradicting);
  };
  Rung seen;
  for (const Silhouette& silhouette : FindSilhouettes(mask, kMostThings)) {
    std::optional<Candidate> candidate = first_of(silhouette, &seen.contradicting);
    const double quality = candidate ? candidate->pair.quality : 0;
    if (candidate) seen.candidates.push_back(*std::move(candidate));
    if (quality < kPlainlyOpen && LooksClosed(silhouette)) seen.closed = 1;
    if (quality >= kAcceptedQuality || like.outlined) continue;
    for (const Silhouette& parted : WithHandlesParted(mask, silhouette)) {
      double contradicting = 0;  // says nothing: few of them are scissors
      auto touching = first_of(parted, &contradicting);
      if (touching) seen.touching.push_back(*std::move(touching));
    }
  }
  const bool resolved = std::ranges::any_of(
      seen.candidates, [](const Candidate& c) { return c.pair.quality >= kAcceptedQuality; });
  if (!resolved && !like.outlined) seen.unresolved.push_back(std::move(in_mask));
  return seen;
}

Rung SeenWithoutHandles(const Candidate& unresolved,
                        const cv::Mat& hidden,
                        const StoredHints& hints) {
  constexpr double kDoubtful = 0.8;
  std::optional<Vector2d> pivot;
  if (hints.pivot_px) pivot = unresolved.at->SmallFromFull(*hints.pivot_px);
  Rung seen;
  for (const Silhouette& silhouette : FindSilhouettes(unresolved.mask, kMostThings)) {
    for (const WithoutHandles& cut : CutOffHandles(silhouette, hidden, pivot)) {
      std::optional<BladePair> pair = FindBladePairAt(cut.silhouette, cut.hidden, cut.crotches);
      if (!pair) continue;
      Candidate in_mask = unresolved;
      in_mask.mask = unresolved.mask & cut.silhouette.filled;
      double contradicting = 0;
      auto candidate =
          FirstOf({*std::move(pair)}, cut.silhouette, in_mask, hidden, hints, &contradicting);
      if (!candidate) continue;
      ApplyGrade(kDoubtful, "the handles are not seen", &candidate->pair);
      seen.candidates.push_back(*std::move(candidate));
    }
  }
  return seen;
}

void Add(Rung seen, Rung* rung) {
  std::move(seen.candidates.begin(), seen.candidates.end(), std::back_inserter(rung->candidates));
  rung->closed += seen.closed;
  rung->contradicting = std::max(rung->contradicting, seen.contradicting);
  rung->rings = std::max(rung->rings, seen.rings);
  CountAgreeing(&rung->candidates);
  std::move(seen.touching.begin(), seen.touching.end(), std::back_inserter(rung->touching));
  CountAgreeing(&rung->touching);
  std::move(seen.unresolved.begin(), seen.unresolved.end(), std::back_inserter(rung->unresolved));
}

}  // namespace bladecurve
